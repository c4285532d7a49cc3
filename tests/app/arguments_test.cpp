// The command line: fixed names, defaults, and one clear line for wrong usage.
#include "app/arguments.h"

#include <gtest/gtest.h>

#include <clocale>
#include <sstream>

#include "engine/error.h"

namespace seascape {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

Arguments parse(const std::string& line) { return parse_arguments(words_of(line)); }

std::string fault_of(const std::string& line) {
  try {
    parse(line);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2) << line;
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << line;
    return error.what();
  }
  return "accepted";
}

TEST(Arguments, NothingMeansExploreOfTheOpenSea) {
  const Arguments arguments = parse("");
  EXPECT_EQ(arguments.command, Command::explore);
  EXPECT_EQ(arguments.scene, "open_sea");
  EXPECT_EQ(arguments.preset, "auto");
  EXPECT_EQ(arguments.display, DisplayKind::automatic);
  EXPECT_EQ(parse("--scene storm").scene, "storm");
  EXPECT_EQ(parse("explore --display headless").display, DisplayKind::headless);
}

// Control seen: simulated before headset in the words alone.
TEST(Arguments, DisplaysAndWhatTheSimulatedHeadsetIsTold) {
  for (const auto& [name, kind] : {std::pair{"auto", DisplayKind::automatic},
                                   {"window", DisplayKind::window},
                                   {"headset", DisplayKind::headset},
                                   {"simulated", DisplayKind::simulated},
                                   {"headless", DisplayKind::headless}}) {
    EXPECT_EQ(parse(std::string("--display ") + name).display, kind) << name;
    EXPECT_EQ(parse(std::string("capture --display ") + name).display, kind) << name;
  }
  const Arguments simulated = parse("--display simulated --input walk --every 30 --out DIR");
  EXPECT_EQ(simulated.input, "walk");
  EXPECT_EQ(simulated.every, 30);
  EXPECT_EQ(parse("--display simulated").input, "");
  EXPECT_EQ(parse("--display simulated").every, 0);
}

// Control: swapping two rows of command_names fails here.
TEST(Arguments, EveryCommandHasItsFixedNames) {
  const Arguments replay = parse(
      "replay --scene S --path P --preset low --size 320x200 --views 1 --eye left --stereo single "
      "--fps 72.5 --frames 9 --start 3 --out DIR --format exr --debug holes");
  EXPECT_EQ(replay.command, Command::replay);
  EXPECT_EQ(replay.scene, "S");
  EXPECT_EQ(replay.path, "P");
  EXPECT_EQ(replay.preset, "low");
  EXPECT_EQ(replay.width, 320);
  EXPECT_EQ(replay.height, 200);
  EXPECT_EQ(replay.views, 1);
  EXPECT_EQ(replay.eye, Eye::left);
  EXPECT_EQ(replay.fps, 72.5);
  EXPECT_EQ(replay.frames, 9);
  EXPECT_EQ(replay.start, 3);
  EXPECT_EQ(replay.out, "DIR");
  EXPECT_EQ(replay.format, PictureFormat::exr);
  ASSERT_EQ(replay.overrides.size(), 2u);
  EXPECT_EQ(
      parse("capture --scene S --path P --preset all --size 1x1 --views 2 --display headless --warmup 1 --frames 2 "
            "--out D")
          .preset,
      "all");
  EXPECT_EQ(parse("capture --against A.csv --repeat 8").against, "A.csv");
  EXPECT_EQ(parse("capture --repeat 8").repeat, 8);
  const Arguments plan = parse("plan --scene S --preset high --json --matrix DIR");
  EXPECT_EQ(plan.command, Command::plan);
  EXPECT_TRUE(plan.json);
  EXPECT_EQ(plan.matrix, "DIR");
  const Arguments query = parse("query --scene S --preset low --time -2.5 --points a.csv --out b.csv");
  EXPECT_EQ(query.command, Command::query);
  EXPECT_EQ(query.points, "a.csv");
  EXPECT_EQ(query.out, "b.csv");
  EXPECT_FALSE(query.times || query.all_columns || query.ray);
  const Arguments all = parse("query --points a --out b --times -1:1:0.5 --columns all --footprint 2 --ray");
  EXPECT_EQ(all.times->all(), (std::vector<double>{-1.0, -0.5, 0.0, 0.5, 1.0}));
  EXPECT_TRUE(all.all_columns && all.ray);
  EXPECT_EQ(all.footprint_m, 2.0);
  const Arguments validate = parse("validate a.json b.gltf");
  EXPECT_EQ(validate.files, (std::vector<std::string>{"a.json", "b.gltf"}));
  EXPECT_TRUE(parse("doctor --json").json);
}

TEST(Arguments, OverridesComeInOrderAndReachTheScene) {
  const Arguments arguments =
      parse("query --points a --out b --seed 9 --set waves.chop=0.5 --set waves.chop=0.25 --time -2.5");
  EXPECT_EQ(arguments.time_s, -2.5);
  const Scene scene = scene_from(arguments, "low");
  EXPECT_EQ(scene.settings.sea.seed, 9u);
  EXPECT_EQ(scene.settings.sea.chop, 0.25);
  EXPECT_EQ(path_from(arguments, scene).name, "open_sea");
  EXPECT_EQ(scene_from(parse("--stereo per-eye --debug lod"), "low").settings.render.stereo, StereoMode::per_eye);
  EXPECT_EQ(scene_from(parse("--stereo per-eye --debug lod"), "low").settings.render.debug, DebugView::lod);
}

// A setting of an effect that a scene lacks gives nothing, which is told. Control seen: set_over_file() without its
// remark.
TEST(Arguments, ASettingOfAnEffectThatTheSceneLacksIsARemark) {
  const auto remarks = [](const std::string& line) { return scene_from(parse(line), "low").remarks; };
  EXPECT_EQ(remarks("--scene open_sea --set level.height_m=2 --set waves.chop=0.5 --set place.texel_m=1 --seed 3"),
            std::vector<std::string>{"--set: level.height_m gives nothing, for the scene does not name the effect "
                                     "'level'; add \"level\" to its \"effects\""});
  EXPECT_TRUE(remarks("--scene rivers --set level.height_m=2 --set flow.speed_mps=1 --set foam.life_s=3").empty());
  EXPECT_EQ(remarks("--scene storm --set level.height_m=2 --set flow.speed_mps=1").size(), 2u);
}

// What presets are on a device comes before what the command line says. Controls seen: the device left out; the device
// after the overrides.
TEST(Arguments, PresetsSuitTheDevice) {
  for (const char* preset : {"low", "ultra"}) {
    EXPECT_EQ(scene_from(parse(""), preset).settings.render.msaa, 4);
    EXPECT_EQ(scene_from(parse(""), preset, DeviceClass::discrete).settings.render.msaa, 4);
    EXPECT_EQ(scene_from(parse(""), preset, DeviceClass::software).settings.render.msaa, 1);
    EXPECT_EQ(scene_from(parse("--set msaa=4"), preset, DeviceClass::software).settings.render.msaa, 4);
  }
}

// Controls: leaving CLI11's own conversions in place gives other words, and none of the ranges; seen: its words for
// what is missing or given twice, values of flags left to it, --time ignored beside --times, --input and --every taken
// for a window.
TEST(Arguments, WrongUsageNamesOptionValueRangeAndRemedy) {
  const std::pair<const char*, const char*> cases[] = {
      {"expore",
       "unknown command 'expore' (did you mean 'explore'?); take explore, replay, capture, lab, bake, plan, query, "
       "validate or "
       "doctor; see seascape --help"},
      {"replay --frame 3", "unknown option '--frame' (did you mean '--frames'?); see seascape replay --help"},
      {"replay --sett a=b", "unknown option '--sett' (did you mean '--set'?); see seascape replay --help"},
      {"replay storm", "unexpected word 'storm'; see seascape replay --help"},
      {"--scene storm replay", "unexpected word 'replay'; see seascape explore --help"},
      {"replay --size 0x5", "--size: '0x5' is out of range; give two whole numbers from 1 to 16384, as 1280x720"},
      {"replay --size 640", "--size: '640' is not WIDTHxHEIGHT; give two whole numbers from 1 to 16384, as 1280x720"},
      {"replay --size 16385x1",
       "--size: '16385x1' is out of range; give two whole numbers from 1 to 16384, as 1280x720"},
      {"replay --size -5x5", "--size: '-5x5' is out of range; give two whole numbers from 1 to 16384, as 1280x720"},
      {"replay --size 9999999999999999999999x1",
       "--size: '9999999999999999999999x1' is not WIDTHxHEIGHT; give two whole numbers from 1 to 16384, as 1280x720"},
      {"query --time= --out o --points p", "--time: no value follows '--time='; leave --time out or give it a value"},
      {"replay --out= 7", "--out: no value follows '--out='; leave --out out or give it a value"},
      {"doctor --json=", "--json: no value follows '--json='; leave --json out or give it a value"},
      {"doctor --json=x", "--json: takes no value; write --json alone"},
      {"lab --quick=no", "--quick: takes no value; write --quick alone"},
      {"replay --help=x", "--help: takes no value; write --help alone"},
      {"replay --fps", "--fps: no value follows it; leave --fps out or give it a value"},
      {"replay --out", "--out: no value follows it; leave --out out or give it a value"},
      {"replay --set", "--set: no value follows it; leave --set out or give it a value"},
      {"replay --fps 3 --fps 4", "--fps: is given more than once; give it once"},
      {"query --points a --out b --time 0 --times 0:1:1", "--times: it and --time are given; leave one of them out"},
      {"replay --fps 0", "--fps: '0' is out of range; give a number from 0.1 to 1000 1/s"},
      {"replay --fps x", "--fps: 'x' is not a number; give a number from 0.1 to 1000 1/s"},
      {"replay --fps nan", "--fps: 'nan' is not a number; give a number from 0.1 to 1000 1/s"},
      {"replay --fps 30,5", "--fps: '30,5' is not a number; give a number from 0.1 to 1000 1/s"},
      {"replay --frames -1", "--frames: '-1' is out of range; give a whole number from 0 to 1000000"},
      {"replay --frames 2.5", "--frames: '2.5' is not a whole number; give a whole number from 0 to 1000000"},
      {"replay --views 3", "--views: '3' is out of range; give a whole number from 1 to 2"},
      {"replay --eye middle", "--eye: unknown value 'middle'; take left, right or centre"},
      {"--display simulate",
       "--display: unknown value 'simulate' (did you mean 'simulated'?); take auto, window, headset, simulated or "
       "headless"},
      {"--input walk", "--input: it is for the simulated headset alone; add --display simulated, or leave it out"},
      {"--display headset --input walk",
       "--input: it is for the simulated headset alone; add --display simulated, or leave it out"},
      {"--every 3", "--every: it is for the simulated headset alone; add --display simulated, or leave it out"},
      {"--display window --every 0",
       "--every: it is for the simulated headset alone; add --display simulated, or leave it out"},
      {"--display simulated --every -1", "--every: '-1' is out of range; give a whole number from 0 to 1000000"},
      {"--display simulated --input=", "--input: no value follows '--input='; leave --input out or give it a value"},
      {"capture --display simulated --input walk", "unknown option '--input'; see seascape capture --help"},
      {"replay --eye left", "--eye: one eye needs one view; add --views 1"},
      {"replay --preset hihg",
       "--preset: unknown value 'hihg' (did you mean 'high'?); take low, medium, high, ultra or auto"},
      {"replay --format jpg", "--format: unknown value 'jpg'; take png or exr"},
      {"--set waves.chop", "--set: 'waves.chop' has no key and value; write --set key=value"},
      {"--set waves.chop=9", "--set: waves.chop: 9 is out of range; give a number from 0 to 2"},
      {"--seed x", "--seed: waves.seed: 'x' is not a number; give a whole number from 0 to 4294967295"},
      {"query --points a --out b --times 0:10",
       "--times: '0:10' is not three numbers with colons between; write A:B:STEP, as 0:10:0.5"},
      {"query --points a --out b --times 5:1:1",
       "--times: '5:1:1' is no span of time; give A and B from -1e9 to 1e9 s, A no later than B"},
      {"query --points a --out b --times 0:1:0",
       "--times: '0:1:0' has no step or more than a million; give a STEP above 0, (B - A) / 1e6 or more"},
      {"query --points a --out b --columns some", "--columns: unknown value 'some'; take basic or all"},
      {"query", "--points: a file is needed; give both, as seascape query --points points.csv --out surface.csv"},
      {"validate", "no file to validate; give one or more, as seascape validate scene.json"},
  };
  for (const auto& [line, message] : cases) EXPECT_EQ(fault_of(line), message) << line;
  EXPECT_NE(fault_of("replay --").find("see seascape"), std::string::npos) << fault_of("replay --");
}

// Control: a command without examples (doctor's emptied) fails here.
TEST(Arguments, EveryCommandHasHelpWithDefaultsUnitsAndExamples) {
  EXPECT_NE(parse("--help").text.find("Examples:"), std::string::npos);
  EXPECT_EQ(parse("--version").text, "seascape 0.1\n");
  for (const std::string command : {"explore", "replay", "capture", "plan", "query", "validate", "doctor"}) {
    SCOPED_TRACE(command);
    EXPECT_NE(parse("--help").text.find("  " + command + " "), std::string::npos);
    const Arguments arguments = parse(command + " --help");
    EXPECT_EQ(arguments.command, Command::text);
    for (const char* part : {"Examples:\n  seascape", "--seed", "--set", "--log-level", "--help"})
      EXPECT_NE(arguments.text.find(part), std::string::npos) << part;
  }
  const std::string help = parse("replay --help").text;
  for (const char* part : {"=open_sea", "=30", "0.1 to 1000 1/s", "=1280x720", "png|exr", "per-eye"})
    EXPECT_NE(help.find(part), std::string::npos) << part << "\n" << help;
}

// Control: std::stod in real_from fails here where a comma-decimal locale is installed; the number stays 72.5
// elsewhere.
TEST(Arguments, NumbersDoNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  EXPECT_EQ(parse("replay --fps 72.5").fps, 72.5);
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace seascape
