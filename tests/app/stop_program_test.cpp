// Two runs into one folder, and runs that a signal ends: who holds a folder is told, what is whole is kept, a line is
// said. Signals come from a library that is loaded before the program's own (tests/support/preload/faults.cpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/files.h"
#include "engine/image_file.h"
#include "tests/support/desktop.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;
using test::Background;
using test::ProgramResult;
using test::run_command;
using test::run_program;
using test::TemporaryFolder;
using test::wait_until;
using testing::HasSubstr;
using testing::StartsWith;

ProgramResult run_stopped(const std::vector<std::string>& words, const std::string& when) {
  const fs::path library = SEASCAPE_FAULTS_LIBRARY;
  return run_program(
      words, {when, "LD_LIBRARY_PATH=" + library.parent_path().string(), "LD_PRELOAD=" + library.filename().string()});
}

void expect_line(const ProgramResult& result, int exit_code, const std::vector<std::string>& parts) {
  EXPECT_EQ(result.exit_code, exit_code) << result.err;
  EXPECT_THAT(result.err, StartsWith("seascape: "));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts) EXPECT_THAT(result.err, HasSubstr(part));
}

bool has_unfinished(const fs::path& folder) {
  const auto files = fs::directory_iterator(folder);
  return std::any_of(begin(files), end(files), [](const fs::directory_entry& entry) {
    return entry.path().filename().string().find(".tmp-") != std::string::npos;
  });
}

std::vector<std::string> small(const char* command, const fs::path& out) {
  return {command,   "--scene", "calm",        "--preset", "low",   "--size",    "16x16",
          "--views", "1",       "--log-level", "error",    "--out", out.string()};
}
std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// A bake that takes minutes.
std::vector<std::string> long_bake(const fs::path& out) {
  return {test::program_file(), "bake", "--scene", "calm", "--frames", "1000", "--size", "512", "--out", out.string()};
}

constexpr int by_term = 128 + SIGTERM;

// Controls seen: make_output_directory() alone in the place of OutputFolder lets each command go on.
TEST(TwoRuns, TheSecondIsToldWhoWritesIntoTheFolder) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  Background first(long_bake(out));
  ASSERT_TRUE(wait_until([&] { return fs::exists(out / "frame_0000.exr") || !first.running(); })) << first.err();
  ASSERT_TRUE(first.running()) << first.err();
  const std::vector<std::string> told{out.string() + ": process ", " bake --scene calm ", "wait until it ends"};
  expect_line(run_program({"bake", "--scene", "calm", "--frames", "8", "--size", "64", "--out", out}), 1, told);
  expect_line(run_program(with(small("replay", out), {"--frames", "1"})), 1, told);
  expect_line(run_program(with(small("capture", out), {"--frames", "1"})), 1, told);
  expect_line(run_program(with(small("explore", out), {"--display", "headless"})), 1, told);
  expect_line(run_program({"plan", "--scene", "calm", "--matrix", out}), 1, told);
  expect_line(run_program({"lab", "--curve", "query", "--quick", "--out", out}), 1, told);
  const ProgramResult within = run_program(with(small("replay", out / "within"), {"--frames", "1"}));
  EXPECT_EQ(within.exit_code, 0) << within.err;
  first.send(SIGKILL);
  EXPECT_EQ(first.exit_code(), 128 + SIGKILL);
  const ProgramResult next = run_program(with(small("replay", out), {"--frames", "1"}));
  EXPECT_EQ(next.exit_code, 0) << next.err;
}

// Controls seen: a handler that ends the program at once, whatever postpones it, tells of no frame; the rows of SIGQUIT
// and SIGXCPU left out say nothing.
TEST(Stopped, ABakeEndsWithALineAndWholeFrames) {
  const TemporaryFolder folder;
  for (const int signal : {SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGXCPU}) {
    std::signal(signal, SIG_DFL);  // whatever this test was started with is inherited
    const fs::path out = folder / std::to_string(signal);
    Background bake(long_bake(out));
    ASSERT_TRUE(wait_until([&] { return fs::exists(out / "frame_0001.exr") || !bake.running(); })) << bake.err();
    bake.send(signal);
    const int exit_code = bake.exit_code();
    expect_line({exit_code, "", bake.err()}, 128 + signal, {"bake: frame ", "/1000: stopped by SIG", "run it again"});
    EXPECT_FALSE(has_unfinished(out));
    EXPECT_FALSE(fs::exists(out / "loop.json"));
    EXPECT_NO_THROW(read_exr(out / "frame_0001.exr"));
  }
}

// Control seen: a handler set in spite of SIG_IGN ends the program.
TEST(Stopped, AnIgnoredSignalStaysIgnored) {
  const TemporaryFolder folder;
  const auto before = std::signal(SIGHUP, SIG_IGN);
  Background bake(long_bake(folder / "out"));
  std::signal(SIGHUP, before);
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "out/frame_0000.exr") || !bake.running(); }));
  bake.send(SIGHUP);
  EXPECT_TRUE(wait_until([&] { return fs::exists(folder / "out/frame_0002.exr") || !bake.running(); }));
  EXPECT_TRUE(bake.running()) << bake.err();
}

// Control seen: without StopLater in write_atomically out.csv.tmp-PID-0 is left and no out.csv.
TEST(Stopped, AFileThatIsBeingWrittenIsWhole) {
  const TemporaryFolder folder;
  std::ofstream(folder / "points.csv") << "x,z\n0,0\n";
  const ProgramResult result = run_stopped(
      {"query", "--scene", "calm", "--preset", "low", "--points", folder / "points.csv", "--out", folder / "out.csv"},
      "SEASCAPE_STOP_AT_WRITE=1");
  expect_line(result, by_term, {"seascape: stopped by SIGTERM; files that it has written are whole"});
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"out.csv", "points.csv"}));
  const std::string text = read_text(folder / "out.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
}

// The number that stands after `before` in a line.
long number_after(const std::string& line, const std::string& before) {
  const std::size_t at = line.find(before);
  return at == std::string::npos ? -1 : std::atol(line.c_str() + at + before.size());
}

// A capture that a signal or the loss of its device ends keeps its whole rows, as a table of another name; the next one
// that comes to its end takes that away. Controls seen: run_capture() without its catch keeps nothing; rows counted
// when they are drawn, before their GPU's time is read, have a nan in them.
TEST(Stopped, ACaptureKeepsItsWholeRows) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out", partial = out / "capture.partial.csv";
  const std::vector<std::string> words = with(small("capture", out), {"--frames", "8", "--warmup", "1"});
  long submissions = 0;
  const ProgramResult whole = run_stopped(words, "SEASCAPE_COUNTS=" + (folder / "counts").string());
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  std::string objects;
  std::ifstream(folder / "counts") >> objects >> submissions;
  const std::string all = read_text(out / "capture.csv");
  for (const char* when : {"SEASCAPE_STOP_AT=", "SEASCAPE_LOSE_AT="}) {
    fs::remove(out / "capture.csv");
    const bool stopped = when == std::string("SEASCAPE_STOP_AT=");
    const ProgramResult result = run_stopped(words, when + std::to_string(submissions - 2));
    expect_line(result, stopped ? by_term : 1,
                {stopped ? "stopped by SIGTERM, the " : "device lost",
                 " rows measured so far are kept in " + partial.string()});
    EXPECT_FALSE(fs::exists(out / "capture.csv"));
    const std::string text = read_text(partial);
    EXPECT_EQ(text.substr(0, 40), all.substr(0, 40));
    const long rows = number_after(result.err, stopped ? "SIGTERM, the " : "(-4), the ");
    EXPECT_GE(rows, 4);
    EXPECT_LE(rows, 8);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), rows + 1) << text;
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
  }
  expect_line(run_stopped(words, "SEASCAPE_STOP_AT=" + std::to_string(submissions - 10)), by_term,
              {"before a row was whole"});
  EXPECT_TRUE(fs::exists(partial));
  EXPECT_EQ(run_program(words).exit_code, 0);
  EXPECT_FALSE(fs::exists(partial));
}

// Control seen: the same.
TEST(Stopped, AReplayLeavesWholePictures) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_stopped(with(small("replay", folder / "out"), {"--frames", "100"}), "SEASCAPE_STOP_AT=8");
  expect_line(result, by_term, {"replay: frame ", "/100: stopped by SIGTERM; "});
  EXPECT_FALSE(fs::exists(folder / "out/replay.json"));
  const long done = number_after(result.err, "replay: frame ");
  const auto files = fs::directory_iterator(folder / "out");
  EXPECT_EQ(std::distance(begin(files), end(files)), done);
  for (const auto& entry : fs::directory_iterator(folder / "out")) EXPECT_EQ(read_png(entry.path()).width, 16);
}

// Controls seen: with SIGPIPE as it comes the program ends without a line, and so it does with SIGXFSZ, of a bake whose
// first frame then stays half written.
TEST(Stopped, AClosedPipeAndAFileThatMayNotGrowAreErrors) {
  const TemporaryFolder folder;
  const auto shell = [&](const std::string& script) {
    return run_command({"sh", "-c", "cd \"$1\" && " + script, test::program_file(), folder.path()});
  };
  expect_line(shell("mkfifo p && exec 3<>p 4>p 3<&- && \"$0\" --help >&4"), 1,
              {"standard output: it cannot be written to; "});
  expect_line(shell("ulimit -f 4 && \"$0\" bake --scene calm --frames 8 --size 64 --out out --log-level error"), 1,
              {"frame_0000.exr: the file would be larger"});
  EXPECT_TRUE(fs::is_empty(folder / "out"));
}

}  // namespace
}  // namespace seascape
