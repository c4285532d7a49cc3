// The command lab from outside: its files, going on after a stop, settings for a budget, and faults.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/lab/lab_files.h"
#include "engine/files.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

namespace fs = std::filesystem;

test::ProgramResult lab(std::vector<std::string> words) {
  words.insert(words.begin(), {test::program_file(), "lab"});
  return test::run_command(words);
}

// Controls seen: parts kept at the end; a part of another seed gone on with; one that is older than the program; a
// part's points measured anew (other times).
TEST(LabProgram, LeavesItsFilesAndGoesOnWhereItWasStopped) {
  const test::TemporaryFolder folder;
  const std::string out = folder / "lab";
  const test::ProgramResult first = lab({"--curve", "fresnel", "--quick", "--out", out});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.out.find("fresnel"), std::string::npos);
  for (const char* name : {"curves.csv", "fresnel.svg", "fresnel_2.svg", "report.html"})
    EXPECT_GT(fs::file_size(fs::path(out) / name), 500u) << name;
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(out)) ++files;
  EXPECT_EQ(files, 4u) << "no parts, no temporary files";
  LabRows rows = parse_curves_csv(read_text(fs::path(out) / "curves.csv"), "curves.csv");
  EXPECT_EQ(rows.points.size(), 3u * 8u * 2u) << "three seas, eight ways, two errors";

  // As if it had been stopped after two of three seas.
  const auto part_of = [&](const std::string& sea) {
    std::vector<LabPoint> part;
    for (const LabPoint& p : rows.points)
      if (p.sea == sea) part.push_back(p);
    return part;
  };
  LabOrigin other = rows.origin;
  other.machine.seed = 99;
  std::ofstream(fs::path(out) / "part_fresnel_U3.csv") << curves_csv(part_of("U3"), rows.origin);
  std::ofstream(fs::path(out) / "part_fresnel_U10.csv") << curves_csv(part_of("U10"), other);
  std::ofstream(fs::path(out) / "part_fresnel_U25.csv") << "half a li";
  const test::ProgramResult second = lab({"--curve", "fresnel", "--quick", "--out", out});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.err.find("part_fresnel_U10.csv is of another"), std::string::npos) << second.err;
  EXPECT_NE(second.err.find("part_fresnel_U25.csv:1"), std::string::npos) << second.err;
  const LabRows again = parse_curves_csv(read_text(fs::path(out) / "curves.csv"), "curves.csv");
  ASSERT_EQ(again.points.size(), rows.points.size());
  int same_3 = 0, same_10 = 0;
  for (std::size_t i = 0; i < rows.points.size(); ++i) {
    const bool same = again.points[i].time_us.p95 == rows.points[i].time_us.p95;
    if (rows.points[i].sea == "U3") same_3 += same;
    if (rows.points[i].sea == "U10") same_10 += same;
    EXPECT_EQ(again.points[i].error.value, rows.points[i].error.value) << "errors do not depend on the machine's hour";
  }
  EXPECT_EQ(same_3, 16);
  EXPECT_LT(same_10, 8);

  // What an older program has measured is not this one's.
  const fs::path old = fs::path(out) / "part_fresnel_U3.csv";
  std::ofstream(old) << curves_csv(part_of("U3"), rows.origin);
  fs::last_write_time(old, fs::last_write_time(test::program_file()) - std::chrono::hours(1));
  const test::ProgramResult third = lab({"--curve", "fresnel", "--quick", "--out", out});
  ASSERT_EQ(third.exit_code, 0) << third.err;
  EXPECT_NE(third.err.find("part_fresnel_U3.csv is older than this program"), std::string::npos) << third.err;
}

// Control seen: --recommend that measures though there are figures.
TEST(LabProgram, RecommendsFromWhatWasMeasured) {
  const test::TemporaryFolder folder;
  std::vector<LabPoint> points;
  for (const char* sea : {"U3", "U10", "U25"})
    for (const double v : {1.0, 2.0, 4.0}) {
      LabPoint p;
      p.curve = "frame", p.knob = "presets", p.value = v, p.sea = sea, p.error = {1.0 / v, "of white"},
      p.settings = "msaa=4 waves.cascades=" + std::to_string(int(v));
      p.time_us.count = 5, p.time_us.median = p.time_us.p5 = p.time_us.p95 = 1000.0 * v;
      points.push_back(p);
    }
  std::ofstream(folder / "curves.csv") << curves_csv(points, {});
  const test::ProgramResult fits = lab({"--recommend", "--budget", "3ms", "--out", folder / ""});
  EXPECT_EQ(fits.exit_code, 0) << fits.err;
  EXPECT_NE(fits.out.find("U25: 2 of 3 ms"), std::string::npos) << fits.out;
  EXPECT_NE(fits.out.find("--set msaa=4 --set waves.cascades=2"), std::string::npos) << fits.out;
  const test::ProgramResult none = lab({"--recommend", "--budget", "0.5", "--out", folder / ""});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.out.find("nothing fits 0.5 ms; the quickest takes 1 ms"), std::string::npos) << none.out;
}

// Control seen: what the lab sets itself told before a key that there is not.
TEST(LabProgram, FaultsAreToldBeforeAnythingIsMeasured) {
  const auto says = [](std::vector<std::string> words, const std::string& what, int code = 2) {
    const test::ProgramResult result = lab(words);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  };
  says({"--curve", "querry"}, "query");
  says({"--recommend"}, "--budget");
  says({"--budget", "4ms"}, "--recommend");
  says({"--recommend", "--budget", "four"}, "not a time");
  says({"--recommend", "--budget", "0"}, "out of range");
  says({"--set", "waves.cascades=3"}, "sets waves.cascades itself");
  says({"--set", "waves.cascade=3"}, "did you mean");  // a wrong key is told first
  says({"--curve", "fresnel", "--quick", "--out", "/proc/no/such"}, "/proc/no/such", 1);
  const test::TemporaryFolder folder;
  std::ofstream(folder / "curves.csv") << "x,z\n";
  says({"--recommend", "--budget", "4ms", "--out", folder / ""}, "curves.csv:1", 1);
}

}  // namespace
}  // namespace seascape
