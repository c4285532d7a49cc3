// `seascape replay` from outside: the eyes that it draws together are those that it draws alone.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "engine/files.h"
#include "tests/support/gpu/picture.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::ProgramResult;
using test::run_program;
using test::TemporaryFolder;

using Files = std::map<std::string, std::vector<std::uint8_t>>;

// Runs replay under validation, which fails on any message, into a folder of its own, and returns the pictures that it
// left there (its record tells times taken; replay_files_program_test.cpp compares the rest of it).
Files replay(std::vector<std::string> words) {
  const TemporaryFolder out;
  words.insert(words.begin(), "replay");
  words.insert(words.end(), {"--size", "96x64", "--out", out.path().string()});
  const ProgramResult result = run_program(words, {"SEASCAPE_VALIDATION=1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  Files files;
  for (const std::string& name : out.names())
    if (name != "replay.json") files[name] = read_bytes(out / name);
  return files;
}

// Control: the eyes differ from each other, so equality is not for want of a difference.
TEST(Replay, BothViewsAreTheEyesDrawnAlone) {
  for (const std::string preset : {"medium", "high"}) {
    const std::vector<std::string> words{"--scene", "storm", "--preset", preset, "--frames", "1"};
    auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), words.begin(), words.end());
      return replay(more);
    };
    const Files both = with({"--views", "2"});
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(with({"--views", "2", "--stereo", "per-eye"}), both);
    const auto left = both.at("frame_0000_left.png"), right = both.at("frame_0000_right.png");
    EXPECT_EQ(with({"--views", "1", "--eye", "left"}).at("frame_0000.png"), left) << preset;
    EXPECT_EQ(with({"--views", "1", "--eye", "right"}).at("frame_0000.png"), right) << preset;
    EXPECT_NE(left, right);
    const test::PictureStatistics s = test::statistics(read_png_from_memory(left, "left"));
    EXPECT_GT(s.mean, 25.0);
    EXPECT_GT(s.deviation, 6.0);
    const Files together = with({"--views", "2", "--set", "stereo.eye_distance_m=0"});
    EXPECT_EQ(together.at("frame_0000_left.png"), together.at("frame_0000_right.png"));
  }
}

// Replays s.json of a folder along its p.json, one view at preset low: keeps the files, returns the record's frames.
nlohmann::json replayed(const TemporaryFolder& folder, const std::string& fps, const std::string& size,
                        const std::vector<std::string>& more, Files& files) {
  const TemporaryFolder out;
  std::vector<std::string> words{"replay",
                                 "--scene",
                                 (folder / "s.json").string(),
                                 "--path",
                                 (folder / "p.json").string(),
                                 "--preset",
                                 "low",
                                 "--views",
                                 "1",
                                 "--fps",
                                 fps,
                                 "--size",
                                 size,
                                 "--out",
                                 out.path().string()};
  words.insert(words.end(), more.begin(), more.end());
  const ProgramResult result = run_program(words, {"SEASCAPE_VALIDATION=1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string& name : out.names()) files[name] = read_bytes(out / name);
  return nlohmann::json::parse(read_text(out / "replay.json")).at("frames");
}

// What floats has lived through what came before, wherever a replay begins: the same picture, with the foam of an
// engine's wash, poses and hash of the sea. A camera rides a body. Controls seen: the frames before --start left out;
// the foam of these frames left out (the picture alone differs).
TEST(Replay, AFrameOfWhatFloatsIsTheSameFromAnyStart) {
  const TemporaryFolder folder;
  const auto scene = [&](const std::string& effects) {
    write_atomically(folder / "s.json", R"({"version": 1, "effects": ["waves", "models", "boats", )" + effects +
                                            R"("wakes"], "objects": [
    {"model": "rib", "name": "A", "at_m": [0, 0, -6], "yaw_deg": 90, "float": {"velocity_mps": [3, 0], "throttle": 1}},
    {"model": "crate", "at_m": [3, 0, -14], "float": {"level": "probes"}}]})");
  };
  scene(R"("foam", "spray", )");
  write_atomically(folder / "p.json", R"({"version": 1, "on": "A", "horizon_lock": 0.5, "keys": [
    {"time_s": 0, "position_m": [0, 4, 12]}, {"time_s": 2, "position_m": [1, 4, 12]}]})");
  const auto record = [&](const std::vector<std::string>& more, Files& files) {
    return replayed(folder, "12", "96x64", more, files);
  };
  Files all, one, none;
  const auto frames = record({"--frames", "18"}, all), alone = record({"--start", "17", "--frames", "1"}, one);
  scene("");
  record({"--start", "17", "--frames", "1"}, none);
  EXPECT_NE(all.at("frame_0017.png"), none.at("frame_0017.png")) << "foam is in the picture";
  ASSERT_EQ(frames.size(), 18u);
  ASSERT_EQ(alone.size(), 1u);
  EXPECT_EQ(all.at("frame_0017.png"), one.at("frame_0017.png"));
  EXPECT_EQ(frames.at(17).at("bodies"), alone.at(0).at("bodies"));
  EXPECT_EQ(frames.at(17).at("sea_hash"), alone.at(0).at("sea_hash"));
  EXPECT_EQ(frames.at(17).at("viewer"), alone.at(0).at("viewer"));
  EXPECT_NE(frames.at(17).at("sea_hash"), frames.at(16).at("sea_hash"));
  ASSERT_EQ(frames.at(17).at("bodies").size(), 2u);
  EXPECT_EQ(frames.at(17).at("bodies").at(0).at("name"), "A");
  EXPECT_NE(frames.at(17).at("bodies").at(0).at("position_m"), frames.at(0).at("bodies").at(0).at("position_m"));
}

// A dive: the path's light shines from its press on, the diver's bubbles are those of the frames before, wherever a
// replay begins, and the record has when the eye went in. Controls seen: presses of the frame alone (the light is
// off from --start); the breath of the frames before left out.
TEST(Replay, ADiveHasItsLightItsBreathAndItsEvents) {
  const TemporaryFolder folder;
  write_atomically(folder / "s.json", R"({"version": 1, "effects": ["waves", "models", "underwater"],
    "waves": {"wind_speed_mps": 0}, "sky": {"sun_elevation_deg": 1}, "objects": [{"model": "crate", "at_m": [0, -2, -3]}]})");
  const auto path = [&](const std::string& actions) {
    write_atomically(folder / "p.json", R"({"version": 1, "keys": [{"time_s": 0, "position_m": [0, 0.5, 0]},
      {"time_s": 2, "position_m": [0, -1.5, 0]}, {"time_s": 9, "position_m": [0, -1.8, 1], "pitch_deg": 55}])" +
                                            actions + "}");
  };
  const auto record = [&](const std::vector<std::string>& more, Files& files) {
    return replayed(folder, "4", "64x48", more, files);
  };
  Files all, one, dark, airless;
  path(R"(, "actions": {"version": 1, "events": [{"time_s": 3, "action": "light", "value": 1}]})");
  const auto frames = record({"--frames", "36"}, all);
  record({"--start", "35", "--frames", "1"}, one);
  record({"--start", "35", "--frames", "1", "--set", "breath.on=false"}, airless);
  path("");
  record({"--frames", "36"}, dark);
  EXPECT_EQ(all.at("frame_0035.png"), one.at("frame_0035.png"));
  EXPECT_NE(all.at("frame_0035.png"), airless.at("frame_0035.png"));
  EXPECT_EQ(all.at("frame_0011.png"), dark.at("frame_0011.png")) << "before the press";
  EXPECT_NE(all.at("frame_0012.png"), dark.at("frame_0012.png")) << "with it";
  EXPECT_NE(all.at("frame_0035.png"), dark.at("frame_0035.png")) << "and after it";
  std::vector<nlohmann::json> events;
  for (const auto& frame : frames)
    for (const auto& event : frame.at("events")) events.push_back(event);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].at("eye"), "centre");
  EXPECT_EQ(events[0].at("event"), "in");
  // Half a metre down of two, on a way that begins at rest: 2 cm past it (a cubic through its keys, to a frame's bend).
  EXPECT_GT(events[0].at("time_s").get<double>(), 0.5);
  EXPECT_LT(events[0].at("time_s").get<double>(), 1.0);
}

}  // namespace
}  // namespace seascape
