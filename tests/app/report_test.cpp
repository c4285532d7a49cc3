#include "app/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <locale>
#include <sstream>

#include "app/report_plots.h"
#include "app/svg.h"
#include "engine/files.h"
#include "tests/support/capture_sample.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using test::capture_run;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Control: passes by their place instead of their name put "fft" of the second run under "surface".
TEST(CaptureCsv, ColumnsAsDesigned) {
  std::vector<CaptureRun> runs{capture_run("high", 12.0, 2, {"surface", "fft"}),
                               capture_run("low", 3.0, 1, {"fft", "sky, \"far\""})};
  const std::vector<std::string> lines = lines_of(capture_csv(runs));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0],
            "scene,preset,frame,time_s,cpu_ms,gpu_ms,draws,triangles,dispatches,missed_72,missed_90,missed_120,"
            "gpu_surface_ms,gpu_fft_ms,\"gpu_sky, \"\"far\"\"_ms\",cpu_waiting_ms,cpu_sea_ms,cpu_recording_ms");
  EXPECT_EQ(lines[1],
            "open_sea,high,0,0.000000,1.5000,12.0000,7,123456,12,0,1,1,8.0000,4.0000,0.0000,0.2500,0.5000,0.1250");
  EXPECT_EQ(lines[2],
            "open_sea,high,1,0.033333,1.5000,12.0100,7,123456,12,0,1,1,8.0067,4.0033,0.0000,0.2500,0.5000,0.1250");
  EXPECT_EQ(lines[3],
            "open_sea,low,0,0.000000,1.5000,3.0000,7,123456,12,0,0,0,0.0000,2.0000,1.0000,0.2500,0.5000,0.1250");
}

// Control: std::max alone takes the CPU's time where the GPU's is NaN.
TEST(CaptureCsv, FrameTimeIsTheLongerAndNanIsAMiss) {
  EXPECT_EQ(frame_ms({0, 0, 3.0, 2.0, 0, 0, 0, {}, {}}), 3.0);
  EXPECT_EQ(frame_ms({0, 0, 3.0, 20.0, 0, 0, 0, {}, {}}), 20.0);
  CaptureRun run = capture_run("low", 3.0, 1, {});
  run.frames[0].gpu_ms = std::nan("");
  EXPECT_THAT(capture_csv({run}), HasSubstr(",nan,7,123456,12,1,1,1,0.2500,0.5000,0.1250\n"));
}

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// Control: memory formatted with the global locale ({:.1Lf}) makes the page differ.
TEST(CaptureCsv, NoDecimalComma) {
  const std::vector<CaptureRun> runs{capture_run("low", 3.05, 3, {"a", "b"})};
  const std::string csv = capture_csv(runs), page = report_html(test::machine(), runs);
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const std::string old_c = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8"})  // where one is installed
    if (std::setlocale(LC_ALL, name)) break;
  EXPECT_EQ(capture_csv(runs), csv);
  EXPECT_EQ(report_html(test::machine(), runs), page);
  std::setlocale(LC_ALL, old_c.c_str());
  std::locale::global(before);
}

// Control: counting a rate as held at any number of misses turns the last sentence into "holds 120 Hz".
TEST(Report, ConclusionsFollowTheFigures) {
  EXPECT_EQ(conclusion(capture_run("high", 61.0, 100, {})),
            "high misses 72 Hz in 100 % of frames: median 61.5, p99 62.0 and longest frame 62.0 ms against 13.9 ms.");
  EXPECT_EQ(conclusion(capture_run("low", 4.0, 100, {})),
            "low holds 120 Hz (0 % of frames missed): median 4.5, p99 5.0 and longest frame 5.0 ms against 8.3 ms.");
  // 12.0 to 12.99 ms: the 80 Hz budget of 12.5 is passed in frames 51 to 99.
  EXPECT_EQ(
      conclusion(capture_run("mid", 12.0, 100, {})),
      "mid holds 72 Hz (0 % of frames missed) and misses 80 Hz in 49.0 % of frames: median 12.5, p99 13.0 and longest "
      "frame 13.0 ms against 12.5 ms.");
  CaptureRun spike = capture_run("low", 4.0, 1000, {});
  for (CaptureFrame& frame : spike.frames) frame.gpu_ms = 4.0;
  spike.frames[5].gpu_ms = 500.0;
  EXPECT_EQ(
      conclusion(spike),
      "low holds 120 Hz (0.1 % of frames missed): median 4.0, p99 4.0 and longest frame 500.0 ms against 8.3 ms.");
  for (int i = 0; i < 11; ++i) spike.frames[static_cast<std::size_t>(i)].gpu_ms = 500.0;
  EXPECT_EQ(conclusion(spike),
            "low misses 72 Hz in 1.1 % of frames: median 4.0, p99 500.0 and longest frame 500.0 ms against 13.9 ms.");
  EXPECT_EQ(conclusion(capture_run("low", 4.0, 0, {})), "low has no frames.");
}

// Control: html_escaped that returns its text lets the script through.
TEST(Report, NamesAreEscapedAndNothingComesFromOutside) {
  const std::string evil = "<script>alert(\"1\")</script>&'";
  CaptureRun run = capture_run(evil, 20.0, 30, {evil, "b"});
  run.scene = evil;
  run.memory.push_back({evil, 5});
  CaptureRun second = run;
  second.preset += "2";
  Machine machine = test::machine();
  machine.device = machine.driver = machine.cpu = machine.build = machine.date = evil;
  const std::string page = report_html(machine, {run, second});
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("alert(\"1")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;&#39;"));
  for (const char* outside : {"http:", "https:", "src=", "href=", "@import", "url("})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  EXPECT_EQ(html_escaped(std::string("a\0b\x1b", 4)), "a?b?");
}

// Control: a table that prints p95 twice lacks the 99th percentile of 12.9801 ms.
TEST(Report, HoldsTheFigures) {
  const std::string page = report_html(test::machine(), {capture_run("mid", 12.0, 100, {"surface", "fft"})});
  for (const char* figure :
       {"12.50</td>", "12.05</td>", "12.94</td>", "12.98</td>", "12.99</td>", ">49.0 %</td>", ">100 %</td>",
        ">0 %</td>", "<td>3.5</td>", "<td>7</td>", "123\u202f456", "1280 × 720, 2 views, 4 × MSAA", "Some driver 1.2",
        "2 cores", "surface: 8.330 ms, 66.7 %", "fft: 4.165 ms, 33.3 %", "waiting: 0.250 ms, 14.3 %",
        "outside any stage: 0.875 ms, 50.0 %", "<dd>42</dd>"})
    EXPECT_THAT(page, HasSubstr(figure));
  EXPECT_THAT(page, Not(HasSubstr("in software")));
  EXPECT_THAT(page, Not(HasSubstr("p99 is little more")));
  Machine lavapipe = test::machine();
  lavapipe.device = "llvmpipe (LLVM 15.0.6, 256 bits)";
  const std::string soft = report_html(lavapipe, {capture_run("mid", 12.0, 99, {"surface", "fft"})});
  EXPECT_THAT(soft, HasSubstr("draws in software"));
  EXPECT_THAT(soft, HasSubstr("With only 99 frames"));
}

// A run that held a frame rate tells how: a sentence, a plot, and three columns, which a run without has empty of
// moves. Controls seen: frames that took just as long counted as late; the columns of the run's last frame in all rows.
TEST(Report, TellsHowAFrameRateWasHeld) {
  CaptureRun run = capture_run("mid", 12.0, 100, {"surface"});
  EXPECT_EQ(report_html(test::machine(), {run}).find("How the frame rate was held"), std::string::npos);
  EXPECT_EQ(capture_csv({run}).find("picture_scale"), std::string::npos);
  run.kept_ms = frame_ms(run.frames[89]);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    run.frames[i].picture_scale = i < 50 ? 1.0 : 0.8;
    run.frames[i].quality = i < 50 ? 1.0 : 0.6;
    run.frames[i].decision = i == 50 ? "over budget: picture scale 1 to 0.8, mesh" : "steady";
  }
  EXPECT_THAT(kept_text(run), HasSubstr(": 10 of 100 frames took longer; mean quality 0.800, picture scale 0.900"));
  const std::string page = report_html(test::machine(), {run, capture_run("other", 12.0, 100, {"surface"})});
  EXPECT_THAT(page, HasSubstr("How the frame rate was held"));
  const std::string csv = capture_csv({run});
  EXPECT_THAT(csv, HasSubstr(",1.0000,1.0000,steady\n"));
  EXPECT_THAT(csv, HasSubstr(",0.8000,0.6000,\"over budget: picture scale 1 to 0.8, mesh\"\n"));
  EXPECT_THAT(csv, HasSubstr(",0.8000,0.6000,steady\n"));
}

// Every tag that is opened is closed, in order. Control: a plot without its </figure> fails.
TEST(Report, TagsMatch) {
  CaptureRun odd = capture_run("odd", 3.0, 40, {"a", "b"});
  odd.kept_ms = 3.0;
  odd.frames[7].gpu_ms = std::nan("");
  odd.frames[8].gpu_ms = 4000.0;
  odd.frames[9].gpu_ms = HUGE_VAL;
  odd.frames[9].time_s = std::nan("");
  CaptureRun none = capture_run("none", 3.0, 0, {});
  none.memory.clear();
  for (const std::vector<CaptureRun>& runs :
       std::vector<std::vector<CaptureRun>>{{},
                                            {none},
                                            {odd},
                                            {capture_run("one", 5.0, 1, {"a", "b"})},
                                            {odd, none, capture_run("b", 90.0, 3000, {"c", "a"})}}) {
    const std::string page = report_html(test::machine(), runs);
    std::vector<std::string> open;
    for (std::size_t at = page.find('<', page.find("<html")); at != std::string::npos; at = page.find('<', at + 1)) {
      const std::size_t end = page.find('>', at);
      ASSERT_NE(end, std::string::npos);
      if (page[end - 1] == '/') continue;
      const bool closing = page[at + 1] == '/';
      const std::string name = page.substr(at + 1 + closing, page.find_first_of(" >", at) - at - 1 - closing);
      if (name == "meta" || name == "br") continue;
      if (closing) {
        ASSERT_FALSE(open.empty()) << name;
        ASSERT_EQ(open.back(), name) << page.substr(at - 60 * (at > 60), 120);
        open.pop_back();
      } else {
        open.push_back(name);
      }
    }
    EXPECT_TRUE(open.empty());
    const std::string plots = runs.empty() ? ""
                                           : frame_time_plot(runs) + named_time_plot(runs, gpu_passes) +
                                                 named_time_plot(runs, cpu_stages) + histogram_plot(runs);
    for (const char* wrong : {"nan", "inf"}) EXPECT_THAT(plots, Not(HasSubstr(wrong)));
  }
}

// Control: every n-th point in place of the least and greatest of each step loses the spike.
TEST(Report, LongRunsStayShortAndKeepTheirSpikes) {
  CaptureRun run = capture_run("long", 10.0, 20000, {"a", "b"});
  for (CaptureFrame& frame : run.frames) frame.gpu_ms = 10.0;
  const std::string flat = frame_time_plot({run});
  run.frames[12345].gpu_ms = 11.0;
  EXPECT_NE(frame_time_plot({run}), flat);
  EXPECT_LT(flat.size(), 40000u);
}

// Seconds are told wherever a run begins. Control seen: steps of labels by the last time alone (one label).
TEST(Report, SecondsAreToldOfRunsThatBeginLate) {
  CaptureRun run = capture_run("late", 10.0, 101, {"a", "b"});
  for (std::size_t i = 0; i < run.frames.size(); ++i) run.frames[i].time_s = 100.0 + 0.1 * double(i);
  const std::string plot = frame_time_plot({run});
  for (int s = 100; s <= 110; ++s) EXPECT_THAT(plot, HasSubstr(">" + std::to_string(s) + " s</text>"));
}

// Control: run_label without its look at the scenes names both runs "low".
TEST(Report, RunsOfSeveralScenesAreTold) {
  CaptureRun a = capture_run("low", 3.0, 5, {"a", "b"}), b = a;
  b.scene = "storm";
  const std::vector<CaptureRun> runs{a, b};
  EXPECT_EQ(run_label(runs[0], runs), "open_sea / low");
  EXPECT_EQ(run_label(runs[1], runs), "storm / low");
  const std::vector<CaptureRun> one{a};
  EXPECT_EQ(run_label(one[0], one), "low");
}

// Control: without the write there is no capture.csv to read.
TEST(Report, FilesAreWritten) {
  const test::TemporaryFolder folder;
  const std::vector<CaptureRun> runs{capture_run("low", 3.0, 5, {"a", "b"})};
  write_capture_csv(folder / "capture.csv", runs);
  write_report(folder / "report.html", test::machine(), runs);
  EXPECT_EQ(read_text(folder / "capture.csv"), capture_csv(runs));
  EXPECT_EQ(read_text(folder / "report.html"), report_html(test::machine(), runs));
  EXPECT_EQ(folder.names().size(), 2u);
}

}  // namespace
}  // namespace seascape
