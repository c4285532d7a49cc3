// Scene files: what is read, and that every fault names file, line, key, value, range and remedy.
#include "app/scene.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "app/camera_path.h"
#include "app/located_json.h"
#include "engine/error.h"

namespace seascape {
namespace {

std::string fault_of(const std::string& text) {
  try {
    parse_scene(text, "s.json", "high");
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 1);
    return error.what();
  }
  return "";
}

TEST(Scene, ReadsWhatItSays) {
  const Scene scene = parse_scene(R"({"version": 1, "title": "T", "effects": ["waves", "foam"], "msaa": 2,
    "waves": {"wind_speed_mps": 12, "seed": 7, "half_storage": true}, "stereo": {"mode": "per-eye"},
    "camera": {"position_m": [1, 2, -3], "yaw_deg": 90, "pitch_deg": 0, "vertical_fov_deg": 75}})",
                                  "s.json", "low");
  EXPECT_EQ(scene.title, "T");
  EXPECT_EQ(scene.effects, (std::vector<std::string>{"waves", "foam"}));
  EXPECT_EQ(scene.settings.render.msaa, 2);
  EXPECT_EQ(scene.settings.sea.wind_speed_mps, 12.0);
  EXPECT_EQ(scene.settings.sea.seed, 7u);
  EXPECT_EQ(scene.settings.render.stereo, StereoMode::per_eye);
  EXPECT_EQ(scene.settings.render.vertical_fov_deg, 75.0);
  EXPECT_EQ(scene.settings.lod.patch_quads, 16) << "the preset comes before the scene";
  EXPECT_EQ(scene.start.position_m, glm::dvec3(1, 2, -3));
  const glm::dvec3 forward = scene.start.orientation * glm::dvec3(0, 0, -1);
  EXPECT_NEAR(forward.x, 1.0, 1e-12) << "yaw is clockwise from -z seen from above: 90 degrees look along +x";
}

// Control: applying the preset after the scene's values fails here.
TEST(Scene, TheScenesOwnValuesWinOverThePreset) {
  const Scene scene = parse_scene(R"({"version": 1, "lod": {"patch_quads": 32}})", "s.json", "ultra");
  EXPECT_EQ(scene.settings.lod.patch_quads, 32);
  EXPECT_EQ(scene.settings.waves.resolution, 512);
  EXPECT_EQ(scene.effects, std::vector<std::string>{"waves"});
}

// Control seen: read_scene() without its remark; without the look at the effects' own faults foam is told of too.
TEST(Scene, SettingsOfAnEffectThatItLacksAreARemark) {
  const std::string text = "{\"version\": 1, \"effects\": [\"waves\"],\n\"level\": {\"height_m\": 2},\n\"sky\": {}}";
  EXPECT_EQ(
      parse_scene(text, "s.json", "low").remarks,
      std::vector<std::string>{"s.json:2: level gives nothing, for the scene does not name the effect 'level'; add "
                               "\"level\" to its \"effects\""});
  Faults faults(true);
  const Scene slip =
      parse_scene(R"({"version": 1, "effects": ["waves", "fome"], "foam": {"life_s": 3}})", "s.json", "low", faults);
  EXPECT_EQ(faults.list().size(), 1u);
  EXPECT_TRUE(slip.remarks.empty());
}

// A set along splines whose only input has a fault: that is told, and not that there is none. Control seen: the remarks
// of gerstner in spite of faults.
TEST(Scene, NoRemarkComesOfAFault) {
  Faults faults(true);
  const Scene scene = parse_scene(R"({"version": 1, "effects": ["waves", "gerstner"],
    "gerstner": {"set1_shore": true, "set1_height_m": 0.3},
    "inputs": [{"to": "gerstner", "kind": "spline", "points": [[0, 0], [9, 0]], "value": 1, "blend": "scale"}]})",
                                  "s.json", "low", faults);
  ASSERT_EQ(faults.list().size(), 1u);
  EXPECT_EQ(faults.list()[0].fault().substr(0, 6), "blend:");
  EXPECT_TRUE(scene.remarks.empty());
}

// Control seen: without the look for it the parser takes a zero byte for the file's end.
TEST(Scene, NothingMayFollowItsEnd) {
  const std::string scene = "{\"version\": 1}\n";
  EXPECT_EQ(fault_of(scene), "");
  EXPECT_EQ(fault_of(scene + std::string("\0", 1)),
            "s.json:2: a zero byte where text should be; save the file as UTF-8 text, without what follows its end");
  EXPECT_EQ(fault_of(scene + std::string("\0 garbage", 9)).substr(0, 20), "s.json:2: a zero byt");
  EXPECT_NE(fault_of(scene + "garbage").find("s.json:2: not valid JSON"), std::string::npos);
  EXPECT_NE(fault_of(scene + "{}").find("s.json:2: not valid JSON"), std::string::npos);
}

// Control: Place::line_of_number without its correction puts this fault on line 4.
TEST(Scene, FaultsNameTheirLine) {
  EXPECT_EQ(fault_of("{\n\"version\": 1,\n\"waves\": {\"chop\":\n3\n}\n}"),
            "s.json:3: waves.chop: 3 is out of range; give a number from 0 to 2");
  EXPECT_EQ(fault_of("{\n\"version\": 1,\n\"camera\": {\"position_m\": [0,\n1,\n1e9\n]}}"),
            "s.json:5: camera.position_m[2]: 1000000000 is out of range; give a number from -10000000 to 10000000 m");
  EXPECT_EQ(fault_of("{\n\"version\": 1,\n\n\"waves\": {\n\"chp\": 3}}").substr(0, 60),
            "s.json:5: unknown key 'waves.chp' (did you mean 'chop'?); re");
}

TEST(Scene, FaultsNameKeyValueRangeAndRemedy) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({})", "s.json:1: the key 'version' is missing; add \"version\": 1"},
      {R"({"version": 2})", "s.json:1: version: 2 is not known; give version 1, the one this program reads"},
      {R"({"version": "1"})", "s.json:1: version: '1' is not known; give version 1, the one this program reads"},
      {R"([])", "s.json:1: the file holds a list of 0; write {\"key\": value, ...}"},
      {R"({"version": 1, "version": 1})",
       "s.json:1: the key 'version' is given twice, first on line 1; remove one of the two"},
      {R"({"version": 1, "waves": 3})", "s.json:1: waves: 3 is not an object; write {\"key\": value, ...}"},
      {R"({"version": 1, "waves": {"chop": "1"}})",
       "s.json:1: waves.chop: '1' is not a number; give a number from 0 to 2"},
      {R"({"version": 1, "waves": {"chop": [1]}})",
       "s.json:1: waves.chop: a list of 1 is not a single value; give 0 to 2"},
      {R"({"version": 1, "waves": {"half_storage": 1}})",
       "s.json:1: waves.half_storage: 1 is neither true nor false; give true or false"},
      {R"({"version": 1, "title": 3})", "s.json:1: title: 3 is not text; write \"text\""},
      {R"({"version": 1, "effects": "waves"})",
       "s.json:1: effects: 'waves' is not a list; write \"effects\": [\"waves\"]"},
      {R"({"version": 1, "effects": ["clouds"]})",
       "s.json:1: effects: the effect 'clouds' is not built yet in this version; remove it"},
      {R"({"version": 1, "effects": ["waves", "waves"]})",
       "s.json:1: effects: 'waves' is given twice; remove one of the two"},
      {R"({"version": 1, "camera": {"position_m": [1, 2]}})",
       "s.json:1: camera.position_m: a list of 2 is not a list of 3 numbers; write [x, y, z]"},
      {R"({"version": 1, "camera": {"pitch_deg": 91}})",
       "s.json:1: camera.pitch_deg: 91 is out of range; give a number from -90 to 90 deg"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(fault_of(text), message) << text;
  EXPECT_NE(fault_of(R"({"version": 1, "effects": ["fom"]})").find("unknown effect 'fom' (did you mean 'foam'?)"),
            std::string::npos);
}

TEST(Scene, BrokenJsonNamesItsLine) {
  const char* broken[] = {"",
                          "{",
                          "{\"version\": 1,}",
                          "{\"version\": NaN}",
                          "{\"version\": 1} x",
                          "{\"a\": \"\xff\"}",
                          "{\"version\": 1e999}",
                          "// c\n{}",
                          "{\"version\": 0x1}"};
  for (const char* text : broken) {
    const std::string message = fault_of(text);
    EXPECT_EQ(message.rfind("s.json:1: not valid JSON: ", 0), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(message.find("json.exception"), std::string::npos);
  }
  EXPECT_EQ(fault_of("{\n\n\"version\" 1}").rfind("s.json:3: ", 0), 0u);
}

TEST(Scene, AFileOfAnotherKindIsSaidToBeOne) {
  EXPECT_EQ(fault_of(R"({"version": 1, "keys": []})"), "s.json: this is a camera path, not a scene; give it to --path");
}

// Control: without the limit in Builder::open the first of these is an unknown key instead.
TEST(Scene, HostileFilesAreRefused) {
  EXPECT_NE(fault_of("{\"a\": " + std::string(100, '[') + std::string(100, ']') + "}").find("nested deeper than 64"),
            std::string::npos);
  EXPECT_NE(fault_of(std::string(3'000'000, '[')).find("nested deeper than 64"), std::string::npos);
  EXPECT_NE(fault_of(std::string((16u << 20) + 1, ' ')).find("at most 16 MiB"), std::string::npos);
}

TEST(Scene, NamesResolveInContentAndAMissingOneNamesTheNearest) {
  EXPECT_EQ(load_scene("storm", "low").name, "storm");
  try {
    load_scene("strom", "low");
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("no scene is called 'strom' (did you mean 'storm'?)"), std::string::npos) << message;
    EXPECT_NE(message.find("aquarium, baked, calm, diving_bell, flotsam, gerstner, harbour, harbour_clip, lagoon, "
                           "open_boat, open_sea, porthole, rain_pool, regatta, rivers, still_life, storm, swell, "
                           "wake_tank, waterline, whirlpool or wreck"),
              std::string::npos)
        << message;
  }
  EXPECT_THROW(load_scene("./no-such-file.json", "low"), Error);
}

// Control: a scene without its path, or one with a key of another name, fails here.
TEST(Scene, EveryShippedSceneReadsAndHasAPathOfItsName) {
  for (const char* name : {"open_sea", "calm", "storm", "swell", "rain_pool", "gerstner", "baked"}) {
    SCOPED_TRACE(name);
    const Scene scene = load_scene(name, "medium");
    EXPECT_FALSE(scene.title.empty());
    EXPECT_EQ(scene.file, content_directory() / "scenes" / (std::string(name) + ".json"));
    const CameraPath path = load_camera_path(name);
    EXPECT_GE(path.duration_s(), 20.0);
    EXPECT_LE(path.duration_s(), 40.0);
  }
}

// Control: a content_directory that ignores the variable fails here.
TEST(Scene, ContentMayLieElsewhere) {
  const std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "sea content";
  std::filesystem::create_directories(directory / "scenes");
  std::ofstream(directory / "scenes" / "mine.json") << R"({"version": 1, "title": "mine"})";
  setenv("SEASCAPE_CONTENT", directory.c_str(), 1);
  EXPECT_EQ(load_scene("mine", "low").title, "mine");
  setenv("SEASCAPE_CONTENT", "/no/such/folder", 1);
  EXPECT_THROW(load_scene("mine", "low"), Error);
  unsetenv("SEASCAPE_CONTENT");
}

}  // namespace
}  // namespace seascape
