// A folder is held by one run at a time, and a run that is gone holds nothing.
#include "engine/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::error_of;
using test::TemporaryFolder;
using testing::HasSubstr;

// Control seen: without the call of flock() nothing is thrown.
TEST(OutputFolder, TheSecondIsToldWhoHoldsIt) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "a/b";
  std::filesystem::create_directory_symlink(out, folder / "link");
  auto first = std::make_unique<OutputFolder>(out);
  const std::string process = "process " + std::to_string(getpid()) + " (";
  EXPECT_THAT(error_of([&] { OutputFolder second(out); }), HasSubstr(out.string() + ": " + process));
  EXPECT_THAT(error_of([&] { OutputFolder second(folder / "link"); }), HasSubstr(process));
  EXPECT_THAT(error_of([&] { OutputFolder second(folder / "a/./b/"); }), HasSubstr("wait until it ends"));
  EXPECT_NO_THROW(OutputFolder(folder / "a"));
  EXPECT_NO_THROW(OutputFolder(folder / "a/b/c"));
  first.reset();
  EXPECT_NO_THROW(OutputFolder second(out));
}

// Control seen: the same; the child's hold is then nobody's.
TEST(OutputFolder, AKilledRunHoldsNothing) {
  const TemporaryFolder folder;
  int told[2];
  ASSERT_EQ(pipe(told), 0);
  const pid_t child = fork();
  if (child == 0) {
    const OutputFolder held(folder.path());
    (void)!write(told[1], "x", 1);
    pause();
  }
  char byte = 0;
  ASSERT_EQ(read(told[0], &byte, 1), 1);
  EXPECT_THAT(error_of([&] { OutputFolder second(folder.path()); }), HasSubstr("process " + std::to_string(child)));
  kill(child, SIGKILL);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_NO_THROW(OutputFolder second(folder.path()));
  EXPECT_TRUE(folder.names().empty());
  close(told[0]);
  close(told[1]);
}

}  // namespace
}  // namespace seascape
