// Every kind of bad input, from outside: one line that names file, key, value and remedy, the exit status, and no file
// left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>

#include <sys/resource.h>

#include "engine/image_file.h"
#include "tests/support/gltf_maker.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;
using test::ProgramResult;
using test::run_command;
using test::run_program;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::vector<std::string> no_driver{"VK_DRIVER_FILES=/nonexistent", "VK_ICD_FILENAMES=/nonexistent"};

std::string write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

// One line: "seascape: WHERE: what is wrong; what to do", holding all of `parts`.
void expect_fault(const ProgramResult& result, int exit_code, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_THAT(result.err, testing::StartsWith("seascape: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.err.empty() ? ' ' : result.err.back(), '\n');
  const std::size_t remedy = result.err.find("; ");
  EXPECT_TRUE(remedy != std::string::npos && remedy + 3 < result.err.size()) << "no remedy: " << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& part : parts) EXPECT_THAT(result.err, HasSubstr(part));
}

struct BadFile {
  const char* text;
  std::vector<std::string> parts;  // what the line must name, besides the file
};

// Scenes are read before a driver is looked for: these tests have none.
// Control: a scene reader that passes unknown keys over (ObjectReader::finish without its body) ended with the driver's
// fault and not the key's.
TEST(FaultsOfScenes, NameFileLineKeyValueAndRemedy) {
  const BadFile scenes[] = {
      {"{\n \"version\": 1,\n \"effects\": [\"waves\"\n", {":3: "}},
      {"{\n \"version\": 1,\n \"wavess\": {}\n}", {":3: ", "wavess", "waves"}},
      {"{\n \"version\": 1,\n \"waves\": {\n  \"wind_speed\": 7\n }\n}",
       {":4: ", "waves.wind_speed", "wind_speed_mps"}},
      {"{\n \"version\": 1,\n \"waves\": {\"wind_speed_mps\": 900}\n}", {":3: ", "waves.wind_speed_mps", "900", "m/s"}},
      {"{\n \"version\": 1,\n \"waves\": {\"wind_speed_mps\": \"fast\"}\n}", {":3: ", "waves.wind_speed_mps", "fast"}},
      {"{\n \"version\": 1,\n \"effects\": [\"waves\", \"fome\"]\n}", {":3: ", "fome", "foam"}},
      {"{\n \"version\": 1,\n \"effects\": [\"clouds\"]\n}", {":3: ", "clouds", "not built"}},
      {"{\n \"version\": 2\n}", {":2: ", "version", "2"}},
      {"[1, 2]", {":1: "}},
      {"", {":1: "}},
  };
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  for (const BadFile& bad : scenes) {
    const std::string file = write(folder / "bad.json", bad.text);
    for (const char* command : {"replay", "capture", "explore"}) {
      const ProgramResult result = run_program({command, "--scene", file, "--out", out}, no_driver);
      expect_fault(result, 1, bad.parts);
      EXPECT_THAT(result.err, testing::StartsWith("seascape: " + file + ":")) << bad.text;
      EXPECT_FALSE(fs::exists(out)) << bad.text;
    }
    expect_fault(run_program({"plan", "--scene", file, "--matrix", out}, no_driver), 1, bad.parts);
    EXPECT_FALSE(fs::exists(out)) << bad.text;
  }
  expect_fault(run_program({"replay", "--scene", folder / "none.json", "--out", out}, no_driver), 1,
               {(folder / "none.json").string(), "no such file"});
  expect_fault(run_program({"replay", "--scene", folder.path().string() + "/", "--out", out}, no_driver), 1,
               {folder.path().string(), "is a folder"});
  EXPECT_FALSE(fs::exists(out));
}

// Control: the same, with `jaw_deg` of the third file.
TEST(FaultsOfPaths, NameFileLineKeyValueAndRemedy) {
  const BadFile paths[] = {
      {"{\n \"version\": 1,\n \"keys\": [\n", {":3: "}},
      {"{\n \"version\": 1,\n \"keys\": [{\"time_s\": 1, \"position_m\": [0, 2, 0]},\n  {\"time_s\": 0, "
       "\"position_m\": [0, 2, 0]}]\n}",
       {":4: ", "keys[1].time_s", "0"}},
      {"{\n \"version\": 1,\n \"keys\": [{\"time_s\": 0, \"position_m\": [0, 2, 0], \"jaw_deg\": 1}]\n}",
       {":3: ", "jaw_deg", "yaw_deg"}},
      {"{\n \"version\": 1,\n \"keys\": [{\"time_s\": 0, \"position_m\": [0, 2]}]\n}", {":3: ", "position_m"}},
      {"{\n \"version\": 1,\n \"keys\": []\n}", {":3: ", "keys"}},
  };
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  for (const BadFile& bad : paths) {
    const std::string file = write(folder / "bad.json", bad.text);
    const ProgramResult result = run_program({"replay", "--preset", "low", "--path", file, "--out", out});
    expect_fault(result, 1, bad.parts);
    EXPECT_THAT(result.err, testing::StartsWith("seascape: " + file + ":")) << bad.text;
  }
  expect_fault(run_program({"capture", "--preset", "low", "--path", "opensea", "--out", out}), 1,
               {"'opensea'", "open_sea"});
  EXPECT_FALSE(fs::exists(out));
}

// Control: a capture that takes every --display in silence told of the driver.
TEST(FaultsOfTheCommandLine, NameOptionValueAndRange) {
  expect_fault(run_program({"replay", "--preset", "hihg"}, no_driver), 2, {"--preset", "'hihg'", "high"});
  expect_fault(run_program({"replay", "--preset", "all"}, no_driver), 2, {"--preset", "'all'"});
  for (const char* size : {"0x5", "640", "640x", "-1x5", "99999x10", "axb", "640x480x2"})
    expect_fault(run_program({"capture", "--size", size}, no_driver), 2,
                 {"--size", "'" + std::string(size) + "'", "1280x720"});
  expect_fault(run_program({"capture", "--views", "3"}, no_driver), 2, {"--views", "'3'", "1 to 2"});
  expect_fault(run_program({"capture", "--display", "headset"}, no_driver), 1, {"--display headset", "headless"});
  expect_fault(run_program({"plan", "--set", "waves.chop=9"}, no_driver), 2, {"--set", "waves.chop", "9"});
  expect_fault(run_program({"replay", "--seed", "-4"}, no_driver), 2, {"--seed", "-4"});
}

// Control: a replay that takes any start ended with 0 and left a folder.
TEST(FaultsOfTheCommandLine, AStartPastThePathIsToldBeforeAFolderIsMade) {
  const TemporaryFolder folder;
  expect_fault(run_program({"replay", "--preset", "low", "--start", "100000", "--out", folder / "out"}), 2,
               {"--start", "100000"});
  EXPECT_TRUE(folder.names().empty());
}

// Control: a validate that keeps the faults of .json alone.
TEST(FaultsOfModelsAndImages, NameFileAndPlace) {
  const TemporaryFolder folder;
  ImageF image{4, 4, std::vector<float>(64, 0.5f)};
  const std::string exr = folder / "half.exr";
  write_exr(exr, image);
  fs::resize_file(exr, fs::file_size(exr) / 2);
  expect_fault(run_program({"validate", exr}, no_driver), 1, {exr});
  expect_fault(run_program({"validate", write(folder / "text.exr", "this is no picture")}, no_driver), 1, {"text.exr"});
  expect_fault(run_program({"validate", write(folder / "bad.gltf", "{\"asset\":")}, no_driver), 1, {"bad.gltf"});
  expect_fault(run_program({"validate", write(folder / "bad.glb", "glTF\2\0\0")}, no_driver), 1, {"bad.glb"});
  test::GltfMaker maker;
  const std::vector<std::uint8_t> bytes = maker.gltf("missing.bin");
  const std::string model = write(folder / "lost.gltf", std::string(bytes.begin(), bytes.end()));
  expect_fault(run_program({"validate", model}, no_driver), 1, {model});
}

// Control: a query that writes its header before it reads the points left out.csv.
TEST(FaultsOfPoints, NameFileLineAndValue) {
  const BadFile tables[] = {{"x,y\n0,0\n", {":1: ", "'x,y'", "x,z"}},
                            {"x,z\n0,0\n1,two\n", {":3: ", "z", "'two'"}},
                            {"x,z\n0,0\n1,nan\n", {":3: ", "'nan'"}},
                            {"x,z\n1,1e300\n", {":2: ", "1e300"}},
                            {"x,z\n1\n", {":2: ", "'1'"}},
                            {"x,z\n", {"no points"}},
                            {"", {":1: "}}};
  const TemporaryFolder folder;
  for (const BadFile& bad : tables) {
    const std::string points = write(folder / "points.csv", bad.text);
    expect_fault(run_program({"query", "--points", points, "--out", folder / "out.csv"}, no_driver), 1, bad.parts);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"points.csv"}) << bad.text;
  }
}

// Control: the message without its remedy.
TEST(FaultsOfTheMachine, NoDriverIsToldWithItsRemedy) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  for (const auto& words :
       std::vector<std::vector<std::string>>{{"replay", "--out", out}, {"capture", "--out", out}, {"plan"}})
    expect_fault(run_program(words, no_driver), 1, {"Vulkan", "mesa-vulkan-drivers"});
  EXPECT_FALSE(fs::exists(out));
  const ProgramResult doctor = run_program({"doctor"}, no_driver);  // tells it as its result
  EXPECT_EQ(doctor.exit_code, 1);
  EXPECT_THAT(doctor.out, HasSubstr("mesa-vulkan-drivers"));
}

// A folder below a file and one below /proc: as unwritable for root as for anyone.
// Control: a capture that does not make its folder before its long work told of capture.csv, not of the folder.
TEST(FaultsOfTheMachine, AnUnwritableFolderIsToldByName) {
  const TemporaryFolder folder;
  const std::string file = write(folder / "file", "kept");
  const std::string points = write(folder / "points.csv", "x,z\n0,0\n");
  for (const std::string& bad : {file + "/below", std::string("/proc/nope"), file}) {
    const std::string told = "seascape: " + bad + ": ";  // the folder, not a file that was to be written into it
    expect_fault(run_program({"replay", "--preset", "low", "--frames", "1", "--out", bad}), 1, {told});
    expect_fault(run_program({"capture", "--preset", "low", "--frames", "1", "--out", bad}), 1, {told});
    expect_fault(run_program({"plan", "--preset", "low", "--matrix", bad}), 1, {told});
  }
  for (const std::string& bad : {file + "/out.csv", std::string("/proc/out.csv"), folder.path().string()})
    expect_fault(run_program({"query", "--points", points, "--out", bad}, no_driver), 1, {bad});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"file", "points.csv"}));
  EXPECT_EQ(fs::file_size(file), 4u);
}

// What a full disk left: whole pictures alone.
void expect_whole_pictures(const fs::path& folder) {
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    EXPECT_EQ(entry.path().extension(), ".png") << entry.path();
    const Image8 picture = read_png(entry.path());
    EXPECT_EQ(picture.width, 64);
    ++pictures;
  }
  EXPECT_GT(pictures, 0) << "the disk should be full in the course of the replay, not before";
}

const std::vector<std::string> long_replay{"replay", "--scene",     "calm",    "--preset", "low",
                                           "--size", "64x36",       "--views", "2",        "--frames",
                                           "60",     "--log-level", "error"};

// Runs a command in a mount namespace of its own with a disk of 64 KiB at `folder`; the files left are copied to
// `kept`.
ProgramResult on_a_small_disk(const fs::path& folder, const fs::path& kept, const std::vector<std::string>& words) {
  std::vector<std::string> command{
      "unshare",
      "--map-root-user",
      "--mount",
      "sh",
      "-c",
      "mount -t tmpfs -o size=64k none \"$1\" || exit 77\n"
      "folder=$1 kept=$2; shift 2; \"$@\"; code=$?; cp -r \"$folder/.\" \"$kept\"; exit $code",
      "sh",
      folder,
      kept,
      test::program_file()};
  command.insert(command.end(), words.begin(), words.end());
  return run_command(command);
}

// Control: write_atomically without the removal of its temporary file left frame_NNNN.png.tmp-... here, and
// out.csv.tmp-... in the test of a limit below.
TEST(FaultsOfTheMachine, AFullDiskLeavesNoPartialFile) {
  const TemporaryFolder folder, kept;
  std::vector<std::string> words = long_replay;
  words.insert(words.end(), {"--out", folder.path()});
  if (run_command({"unshare", "--map-root-user", "--mount", "true"}).exit_code != 0)
    GTEST_SKIP() << "no mount namespaces here; the two tests below stand in";
  const ProgramResult result = on_a_small_disk(folder.path(), kept.path(), words);
  if (result.exit_code == 77) GTEST_SKIP() << "no tmpfs may be mounted here; the two tests below stand in";
  expect_fault(result, 1, {folder.path().string() + "/frame_", "the disk is full", "free some space"});
  expect_whole_pictures(kept.path());
}

// Where no disk can be mounted: names that lead to a device that is always full. Nothing else may be left.
// Control: a write to a device whose result is not looked at ended with 0.
TEST(FaultsOfTheMachine, AFullDeviceBehindANameIsToldByThatName) {
  const TemporaryFolder folder;
  for (const char* name : {"frame_0000.png", "capture.csv", "plan_calm_low.csv"})
    fs::create_symlink("/dev/full", folder / name);
  const std::vector<std::string> names = folder.names();
  const std::string full = "the disk is full";
  const std::vector<std::string> drawn{"--scene", "calm",    "--preset", "low",         "--size",
                                       "16x16",   "--views", "1",        "--log-level", "error"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), drawn.begin(), drawn.end());
    return run_program(words);
  };
  expect_fault(with({"replay", "--frames", "1", "--out", folder.path()}), 1,
               {(folder / "frame_0000.png").string(), full});
  expect_fault(with({"capture", "--frames", "1", "--out", folder.path()}), 1,
               {(folder / "capture.csv").string(), full});
  expect_fault(with({"plan", "--matrix", folder.path()}), 1, {(folder / "plan_calm_low.csv").string(), full});
  EXPECT_EQ(folder.names(), names);
}

// A quota, for whoever may not mount: the size of files is limited. (Not for what draws: lavapipe keeps its memory in
// files.)
TEST(FaultsOfTheMachine, AFileThatMayNotGrowLeavesNoPartialFile) {
  const TemporaryFolder folder;
  std::string many = "x,z\n";
  for (int i = 0; i < 200; ++i) many += std::to_string(i) + ",0\n";
  const std::string points = write(folder / "points.csv", many);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // else the signal ends the writer; both are inherited
  rlimit small = before;
  small.rlim_cur = 2048;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const ProgramResult query =
      run_program({"query", "--preset", "low", "--points", points, "--out", folder / "out.csv"}, no_driver);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  expect_fault(query, 1, {(folder / "out.csv").string()});
  EXPECT_EQ(folder.names(), std::vector<std::string>{"points.csv"});
}

// Control: replay without --debug.
TEST(Help, OfEveryCommandNamesItsOptions) {
  const std::pair<const char*, std::vector<std::string>> commands[] = {
      {"explore", {"--scene", "--preset", "--display"}},
      {"replay",
       {"--scene", "--path", "--preset", "--size", "--views", "--eye", "--stereo", "--fps", "--frames", "--start",
        "--out", "--format", "--debug"}},
      {"capture", {"--scene", "--path", "--preset", "--size", "--views", "--display", "--warmup", "--frames", "--out"}},
      {"plan", {"--scene", "--preset", "--json", "--matrix"}},
      {"query", {"--scene", "--preset", "--time", "--points", "--out"}},
      {"validate", {"FILE"}},
      {"doctor", {"--json"}}};
  for (const auto& [command, options] : commands) {
    const ProgramResult help = run_program({command, "--help"}, no_driver);
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_EQ(help.err, "");
    for (const std::string& option : options) EXPECT_THAT(help.out, HasSubstr(option)) << command;
    for (const char* common : {"--seed", "--log-level", "--set"}) EXPECT_THAT(help.out, HasSubstr(common)) << command;
  }
  EXPECT_EQ(run_program({"--help"}, no_driver).exit_code, 0);
}

}  // namespace
}  // namespace seascape
