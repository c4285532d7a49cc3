// The command query from outside: one sea whatever the processor's cores.
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "engine/files.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

// The processors that this process may use.
std::vector<int> processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> result;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return result;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &set)) result.push_back(i);
  return result;
}

// Control seen: the sea not stepped.
TEST(QueryProgram, KnowsDynamicWaves) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "points.csv") << "x,z\n0,0\n0.5,0.5\n";
  const auto heights = [&](const std::string& rain) {
    const std::string out = folder / ("out" + rain + ".csv");
    const test::ProgramResult result =
        test::run_command({test::program_file(), "query", "--scene", "rain_pool", "--time", "2", "--set",
                           "dynamic_waves.rain_per_m2_s=" + rain, "--points", folder / "points.csv", "--out", out});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return read_text(out);
  };
  EXPECT_NE(heights("2"), heights("0"));
}

// TBB takes as many threads as a process may use processors, so util-linux's taskset sets their number.
TEST(QueryProgram, TwoProcessesWithDifferentNumbersOfThreadsGiveTheSameBits) {
  // Controls: another seed gives other bytes (below); a share of the waves scaled by 1 + 1e-6 (threads - 1) in the
  // query gives other bytes for one thread than for two.
  const std::vector<int> all = processors();
  if (all.size() < 2) GTEST_SKIP() << "one processor only";
  const test::TemporaryFolder folder;
  const std::string points = folder / "points.csv";
  std::string text = "x,z\n";
  for (int i = 0; i < 9000; ++i)
    text += std::to_string(i * 7 % 1999 - 1000) + ".25," + std::to_string(i * 13 % 4001 - 2000) + ".5\n";
  std::ofstream(points, std::ios::binary) << text;
  const auto heights = [&](const std::string& on, const std::string& seed) {
    const std::string out = folder / ("out_" + on + "_" + seed + ".csv");
    const test::ProgramResult result =
        test::run_command({"taskset", "-c", on, test::program_file(), "query", "--scene", "open_sea", "--preset",
                           "medium", "--seed", seed, "--time", "1234.5", "--points", points, "--out", out});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_text(out);
  };
  const std::string one = std::to_string(all.front()), more = one + "-" + std::to_string(all.back());
  const std::string by_one = heights(one, "7");
  EXPECT_EQ(std::count(by_one.begin(), by_one.end(), '\n'), 9001);
  EXPECT_TRUE(heights(more, "7") == by_one);
  EXPECT_FALSE(heights(more, "8") == by_one);
}

}  // namespace
}  // namespace seascape
