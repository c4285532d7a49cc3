// `seascape replay` from outside: the eyes that it draws together are those that it draws alone.
#include <gtest/gtest.h>

#include <map>

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

}  // namespace
}  // namespace seascape
