// One clock, one sea: two processes that are given the same one, from outside.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/files.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

const std::vector<std::string> scenes{"gerstner", "baked", "rain_pool"};

std::vector<std::string> with(std::vector<std::string> words, std::initializer_list<std::string> more) {
  words.insert(words.end(), more);
  return words;
}

// Pictures by name, and the sea's time of the first.
std::map<std::string, std::vector<std::uint8_t>> replay(const std::vector<std::string>& words,
                                                        double* time_s = nullptr) {
  const test::TemporaryFolder out;
  const test::ProgramResult result =
      test::run_program(with(words, {"--size", "48x32", "--views", "1", "--out", out.path().string()}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::vector<std::uint8_t>> files;
  for (const std::string& name : out.names())
    if (name != "replay.json") files[name] = read_bytes(out / name);
  if (time_s)
    *time_s = nlohmann::json::parse(read_text(out / "replay.json"))["frames"][0]["scene_time_s"].get<double>();
  return files;
}

std::string query(const std::vector<std::string>& words) {
  const test::TemporaryFolder folder;
  std::string points = "x,z\n";
  for (int i = 0; i < 300; ++i)
    points += std::to_string(i * 7 % 199 - 100) + ".25," + std::to_string(i * 13 % 401 - 200) + ".5\n";
  std::ofstream(folder / "in.csv", std::ios::binary) << points;
  const std::string out = folder / "out.csv";
  const test::ProgramResult result = test::run_program(with(words, {"--points", folder / "in.csv", "--out", out}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return read_text(out);
}

// A server's clock that says 1e7 s more, told as an offset by one process and as the start by the other; and the query
// of that time by two. Controls within: a thousandth of a second more is another sea and another picture; query of the
// first's time is not that of the next.
TEST(OneClock, TwoProcessesShowOneSea) {
  for (const std::string& scene : scenes) {
    SCOPED_TRACE(scene);
    const std::vector<std::string> words{"replay", "--scene", scene, "--preset", "low", "--frames", "2", "--fps", "4"};
    double time_s = 0.0;
    const auto by_offset = replay(with(words, {"--set", "time.offset_s=10000000"}), &time_s);
    ASSERT_EQ(by_offset.size(), 2u);
    EXPECT_EQ(time_s, 1e7);
    EXPECT_TRUE(replay(with(words, {"--set", "time.start_s=10000000"})) == by_offset);
    EXPECT_FALSE(replay(with(words, {"--set", "time.offset_s=10000000.25"})) == by_offset);
    // Dynamic waves are stepped from the clock's beginning, which is told too.
    const std::vector<std::string> ask{"query", "--scene", scene, "--preset", "low", "--time"};
    const std::string asked = query(with(ask, {"10000000", "--set", "time.offset_s=10000000"}));
    const auto from_start = [&](const std::string& at_s, const std::string& more) {
      return query(with(ask, {at_s, "--set", "time.start_s=10000000", "--set", more}));
    };
    EXPECT_TRUE(from_start("10000000", "time.scale=0") == asked) << "--time is the sea's own";
    EXPECT_FALSE(from_start("10000000.001", "time.scale=1") == asked);
  }
}

// Backwards from 100 s is what forwards to it was, frame by frame; stopped, all frames are one.
TEST(OneClock, RunsBackwardsAndStandsStill) {
  const std::vector<std::string> words{"replay", "--scene", "gerstner", "--preset",        "low", "--frames", "3",
                                       "--fps",  "1",       "--set",    "time.start_s=100"};
  // The camera moves with the path, so that frames are compared by the sea's time told for them.
  double first_s = 0.0;
  (void)replay(with(words, {"--set", "time.scale=-2", "--start", "2"}), &first_s);
  EXPECT_EQ(first_s, 96.0);
  const auto backwards = replay(with(words, {"--set", "time.scale=-1"})),
             forwards = replay(with(words, {"--set", "time.scale=1"}));
  EXPECT_TRUE(backwards.at("frame_0000.png") == forwards.at("frame_0000.png"));
  EXPECT_FALSE(backwards.at("frame_0001.png") == forwards.at("frame_0001.png"));
  // 99 s, a second later along the path: by running back from 100, or forwards from 98.
  const auto from_98 = replay(
      {"replay", "--scene", "gerstner", "--preset", "low", "--frames", "3", "--fps", "1", "--set", "time.start_s=98"});
  EXPECT_TRUE(from_98.at("frame_0001.png") == backwards.at("frame_0001.png"));
  (void)replay(with(words, {"--set", "time.scale=0", "--start", "2"}), &first_s);
  EXPECT_EQ(first_s, 100.0);
}

}  // namespace
}  // namespace seascape
