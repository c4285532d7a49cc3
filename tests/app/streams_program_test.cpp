// Names that are no plain files, and files that are read and written at once: what is behind a descriptor stays, a pipe
// that nobody fills is told of, and no input is overwritten.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
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

std::string write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  return file.string();
}

const std::string points = "x,z\n0,0\n1,1\n";

std::vector<std::string> query(const std::string& in, const std::string& out) {
  return {"query", "--scene", "calm", "--preset", "low", "--points", in, "--out", out};
}

// Control seen: write_atomically() without leads_to_descriptor() loses the first and the last line.
TEST(Streams, ATableForStandardOutputIsAppendedToTheFileBehindIt) {
  const TemporaryFolder folder;
  write(folder / "in.csv", points);
  const std::string ask = "\"$0\" query --scene calm --preset low --points ";
  const ProgramResult result = run_command({"sh", "-c",
                                            "cd \"$1\" && { echo first; " + ask + "in.csv --out /dev/stdout; " + ask +
                                                "/dev/stdin --out /dev/fd/1 <in.csv; cat in.csv | " + ask +
                                                "/dev/stdin --out /dev/stdout; echo last; } >> all",
                                            test::program_file(), folder.path()});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::string text = read_text(folder / "all");
  EXPECT_EQ(text.substr(0, 16), "first\nx,z,height");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3 * 3 + 2) << text;
  EXPECT_THAT(text, testing::EndsWith("\nlast\n"));
}

// Control seen: run_query() without refuse_to_replace() overwrites in.csv.
TEST(Streams, AQueryDoesNotOverwriteWhatItReads) {
  const TemporaryFolder folder;
  const std::string in = write(folder / "in.csv", points);
  fs::create_symlink("in.csv", folder / "soft.csv");
  fs::create_hard_link(in, folder / "hard.csv");
  const fs::path scene = folder / "s.json";
  write_exr(folder / "bed.exr", {2, 2, std::vector<float>(16, 0.5f)});
  write(scene, R"({"version": 1, "effects": ["waves", "sea_depth"], "inputs": [
    {"to": "sea_depth", "kind": "texture", "file": "bed.exr", "at_m": [0, 0], "size_m": 9}]})");
  const auto bytes = read_bytes(folder / "bed.exr");
  for (const fs::path& out : {folder / "in.csv", folder / "soft.csv", folder / "hard.csv", scene, folder / "bed.exr"}) {
    const ProgramResult result =
        run_program({"query", "--scene", scene, "--preset", "low", "--points", in, "--out", out});
    EXPECT_EQ(result.exit_code, 2) << out;
    EXPECT_THAT(result.err, HasSubstr("seascape: --out: '" + out.string() + "' is the file '"));
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  EXPECT_EQ(read_text(in), points);
  EXPECT_EQ(read_bytes(folder / "bed.exr"), bytes);
  EXPECT_EQ(read_text(scene).substr(0, 12), "{\"version\": ");
  for (const char* name : {"capture.csv", "capture.partial.csv"}) {
    const std::string capture = write(folder / name, "as it was");
    const ProgramResult against =
        run_program({"capture", "--scene", "calm", "--repeat", "8", "--against", capture, "--out", folder.path()});
    EXPECT_EQ(against.exit_code, 2);
    EXPECT_THAT(against.err, HasSubstr("--out: '" + capture + "' of --against would be lost; "));
    EXPECT_EQ(read_text(capture), "as it was");
  }
}

// Controls seen: without InputWait nothing is said, and neither of a writer without open_to_write()'s line.
TEST(Streams, APipeThatNobodyServesIsToldOf) {
  const TemporaryFolder folder;
  const std::string in = folder / "pipe.json", table = folder / "pipe.csv", file = write(folder / "in.csv", points);
  for (const std::string& pipe : {in, table}) ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto said = [](Background& program, const std::string& line) {
    return wait_until([&] { return program.err().find(line) != std::string::npos || !program.running(); }) &&
           program.running();
  };
  const auto of = [](std::vector<std::string> words) {
    words.insert(words.begin(), test::program_file());
    return words;
  };
  Background validate(of({"validate", in})), reads(of(query(table, folder / "out.csv"))),
      replay(of({"replay", "--scene", in, "--out", folder / "out"}));
  EXPECT_TRUE(said(validate, "info: waiting for " + in + ", a pipe: its writer has not closed it\n")) << validate.err();
  EXPECT_TRUE(said(replay, "info: waiting for " + in)) << replay.err();
  EXPECT_TRUE(said(reads, "info: waiting for " + table)) << reads.err();
  write(table, points);
  EXPECT_EQ(reads.exit_code(), 0) << reads.err();
  Background to_a_pipe(of(query(file, table)));
  EXPECT_TRUE(said(to_a_pipe, "info: waiting for a reader of " + table + ", a pipe\n")) << to_a_pipe.err();
  EXPECT_EQ(read_text(table), read_text(folder / "out.csv"));
  EXPECT_EQ(to_a_pipe.exit_code(), 0) << to_a_pipe.err();
}

}  // namespace
}  // namespace seascape
