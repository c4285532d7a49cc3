#include "app/trace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/files.h"
#include "tests/support/capture_sample.h"
#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

using nlohmann::json;
using test::capture_run;

// Control: names put in without quoting them break the JSON.
TEST(Trace, AnyNameIsValidJson) {
  std::string every;
  for (int c = 0; c < 256; ++c) every += static_cast<char>(c);
  const TraceEvent slice{TraceEvent::Kind::slice, every, every, every, 1.5, 2.25, {{every, 3.0}, {"\"", std::nan("")}}};
  const TraceEvent counter{TraceEvent::Kind::counter, "p", "", "c\\", std::nan(""), 0.0, {{"x", 1e300}}};
  const json parsed = json::parse(trace_json({slice, counter}));
  const json& events = parsed.at("traceEvents");
  ASSERT_EQ(events.size(), 6u);  // two processes, a track's name and order, the events
  EXPECT_EQ(events[4].at("ph"), "X");
  EXPECT_EQ(events[4].at("ts"), 1.5);
  EXPECT_EQ(events[4].at("dur"), 2.25);
  EXPECT_TRUE(events[4].at("args").at("\"").is_null());
  EXPECT_NE(events[4].at("name").get<std::string>().find("ABC"), std::string::npos);
  EXPECT_EQ(events[5].at("ts"), 0.0);
  EXPECT_EQ(events[5].at("args").at("x"), 1e300);
  EXPECT_TRUE(json::parse(trace_json({})).at("traceEvents").empty());
}

// Control: `now` left where it is after a frame makes all frames overlap at 0.
TEST(Trace, FramesAndPassesDoNotOverlap) {
  CaptureRun low = capture_run("low", 3.0, 20, {"fft", "surface", "sky"}),
             high = capture_run("high", 30.0, 10, {"fft"});
  low.frames[3].gpu_ms = 1.0;                         // less than its passes together
  low.frames[4].pass_ms = {1.0, std::nan(""), -5.0};  // a timer that failed
  low.frames[5].cpu_ms = 50.0;
  const json events = json::parse(trace_json(trace_of({low, high}))).at("traceEvents");
  std::map<int, std::string> processes;
  std::map<std::pair<int, int>, std::string> tracks;
  std::map<std::pair<int, int>, double> ends;
  std::map<std::string, int> slices;
  std::set<std::string> counters;
  for (const json& event : events) {
    const int pid = event.at("pid"), tid = event.at("tid");
    if (event.at("name") == "process_name") processes[pid] = event.at("args").at("name");
    if (event.at("name") == "thread_name") tracks[{pid, tid}] = event.at("args").at("name");
    if (event.at("ph") == "C") counters.insert(event.at("name").get<std::string>());
    if (event.at("ph") != "X") continue;
    const double start = event.at("ts"), length = event.at("dur");
    ASSERT_TRUE(tracks.contains({pid, tid}));
    EXPECT_GE(start, ends[std::pair(pid, tid)] - 0.0015) << event;  // times are rounded to a nanosecond
    EXPECT_GE(length, 0.0);
    ends[{pid, tid}] = start + length;
    ++slices[processes[pid] + "/" + tracks[{pid, tid}]];
  }
  EXPECT_EQ(processes.size(), 2u);
  EXPECT_EQ(slices["low/CPU"], 20);
  EXPECT_EQ(slices["low/GPU"], 20);
  EXPECT_EQ(slices["low/GPU passes"], 58);  // 60 less the two without a length
  EXPECT_EQ(slices["high/GPU passes"], 10);
  EXPECT_EQ(slices["low/CPU stages"], 60);
  EXPECT_EQ(counters, (std::set<std::string>{"draws", "triangles", "dispatches", "memory MiB"}));
}

// Control: milliseconds left as they are give 3 in place of 3000.
TEST(Trace, UnitsAreMicroseconds) {
  const std::vector<TraceEvent> events = trace_of({capture_run("low", 3.0, 2, {"fft"})});
  std::vector<double> starts;
  for (const TraceEvent& event : events)
    if (event.track == "GPU") {
      starts.push_back(event.start_us);
      EXPECT_NEAR(event.duration_us, 3000.0 + 10.0 * static_cast<double>(starts.size() - 1), 1e-9);
    }
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_DOUBLE_EQ(starts[1], 3000.0);
}

// Control: another text in the file differs.
TEST(Trace, FileIsWritten) {
  const test::TemporaryFolder folder;
  const std::vector<CaptureRun> runs{capture_run("low", 3.0, 2, {"fft"})};
  write_trace(folder / "trace.json", runs);
  EXPECT_EQ(read_text(folder / "trace.json"), trace_json(trace_of(runs)));
}

}  // namespace
}  // namespace seascape
