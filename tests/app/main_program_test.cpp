// The program from outside: exit status, one line a fault, whole files or none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "app/scene.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::ProgramResult;
using test::run_program;

// No driver of Vulkan can be found: what needs no GPU must not notice.
const std::vector<std::string> no_gpu{"VK_DRIVER_FILES=/nonexistent", "VK_ICD_FILENAMES=/nonexistent"};

// Control: a main that prints Error::fault() alone, or returns 1 for wrong usage, fails here.
TEST(Program, WrongUsageIsOneLineAndExitTwo) {
  const std::vector<std::vector<std::string>> wrong{{"expore"},
                                                    {"replay", "--frame", "3"},
                                                    {"replay", "--size", "0x5"},
                                                    {"capture", "--preset", "hihg"},
                                                    {"explore", "--display", "tv"},
                                                    {"plan", "--set", "waves.chop=9"},
                                                    {"query"},
                                                    {"validate"},
                                                    {"doctor", "--a\nb"}};
  for (const auto& words : wrong) {
    const ProgramResult result = run_program(words, no_gpu);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_EQ(result.err.rfind("seascape: ", 0), 0u) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.out.empty());
  }
}

// Control: a main without its catch of Error ends by signal 6 (exit 134) here.
TEST(Program, FaultsAreOneLineAndExitOne) {
  const std::vector<std::vector<std::string>> faults{
      {"replay", "--scene", "strom"},
      {"query", "--scene", "/no/such.json", "--points", "a", "--out", "b"},
      {"query", "--points", "/no/such.csv", "--out", "b"},
      {"validate", "/no/such.json"}};
  for (const auto& words : faults) {
    const ProgramResult result = run_program(words, no_gpu);
    EXPECT_EQ(result.exit_code, 1) << words[0];
    EXPECT_EQ(result.err.rfind("seascape: ", 0), 0u) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(Program, HelpAndVersionGoToStandardOutput) {
  const ProgramResult help = run_program({"replay", "--help"}, no_gpu);
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, testing::HasSubstr("--fps NUMBER=30"));
  EXPECT_TRUE(help.err.empty());
  EXPECT_EQ(run_program({"--version"}, no_gpu).out, "seascape 0.1\n");
}

// Control: a main that does not look at its standard output ends with 0 here.
TEST(Program, AFullDiskUnderStandardOutputIsAFault) {
  const ProgramResult result = run_program({"--help"}, no_gpu, "/dev/full");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::StartsWith("seascape: standard output: it cannot be written to; "));
}

TEST(Program, ValidateTellsEveryFileAndQueryNeedsNoGpu) {
  const test::TemporaryFolder folder;
  const std::string points = folder / "points.csv", out = folder / "out.csv";
  std::ofstream(points) << "x,z\n0,0\n10.5,-3\n";
  const ProgramResult query = run_program(
      {"query", "--scene", "calm", "--time", "3.5", "--preset", "low", "--points", points, "--out", out}, no_gpu);
  EXPECT_EQ(query.exit_code, 0) << query.err;
  EXPECT_TRUE(std::filesystem::exists(out));
  const std::string scene = content_directory() / "scenes" / "calm.json";
  const ProgramResult validate = run_program({"validate", scene, points}, no_gpu);
  EXPECT_EQ(validate.exit_code, 1);
  EXPECT_THAT(validate.out, testing::HasSubstr("calm.json: a scene with 2 effects"));
  EXPECT_THAT(validate.err, testing::HasSubstr("the kind '.csv' is not known"));
}

}  // namespace
}  // namespace seascape
