#include "app/against.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/error.h"

namespace seascape {
namespace {

using testing::HasSubstr;

const std::vector<std::string> stages{"sea",   "waves",     "places",    "foam",
                                      "spray", "traversal", "recording", "submission"};

// Runs of a path whose times vary as on a machine that others use: a speed of its own that drifts, stages that vary by
// themselves, some frames that take several times as long, and a stage that is some per cent off for as long as the
// run's memory lies where it does.
std::vector<CaptureRun> noisy(std::uint64_t seed, const std::string& slower = "", double by = 1.0, int runs = 8) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any;
  std::vector<CaptureRun> all;
  const double speed = std::exp(0.3 * normal(random));
  for (int r = 0; r < runs; ++r) {
    CaptureRun run;
    run.scene = "storm";
    run.preset = "high";
    run.stage_names = stages;
    run.stage_names.push_back("waiting");
    std::vector<double> of_run;
    for (std::size_t k = 0; k < stages.size(); ++k) of_run.push_back(std::exp(0.01 * normal(random)));
    double drift = 0.05 * normal(random);
    for (int i = 0; i < 100; ++i) {
      drift = 0.98 * drift + 0.01 * normal(random);
      CaptureFrame frame;
      frame.frame = i;
      for (std::size_t k = 0; k < stages.size(); ++k) {
        // What the stage has to do along the path, the same in all runs.
        const double work = (0.8 + 0.15 * double(k)) * (1.0 + 0.6 * std::sin(0.05 * i * double(k + 1)));
        double ms = work * speed * std::exp(drift + 0.06 * std::abs(normal(random))) * of_run[k];
        if (any(random) < 0.02) ms *= 1.0 + 5.0 * any(random);
        if (stages[k] == slower) ms *= by;
        frame.stage_ms.push_back(ms);
        frame.cpu_ms += ms;
      }
      frame.stage_ms.push_back(5.0 * any(random));  // waiting
      run.frames.push_back(frame);
    }
    all.push_back(run);
  }
  return all;
}

std::vector<std::string> changed(const std::vector<CaptureRun>& before, const std::vector<CaptureRun>& now) {
  std::vector<std::string> names;
  const std::vector<RunChange> runs = compare_captures(before, now);
  for (const StageChange& stage : runs.at(0).stages)
    if (stage.changed()) names.push_back(stage.name);
  return names;
}

// Controls seen: what the stages have in common left in (4 of 40 found); means of the runs instead of the shortest
// times (30).
TEST(Against, FindsTenPerCentInOneStage) {
  int found = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const std::string& slower = stages[i % stages.size()];
    found += changed(noisy(2 * i), noisy(2 * i + 1, slower, 1.1)) == std::vector{"cpu_" + slower + "_ms"};
  }
  EXPECT_GE(found, 38);
}

// The same controls: nothing in 3 and 33 of 40.
TEST(Against, FindsNothingBetweenTwoRunsOfOneBuild) {
  int none = 0;
  for (std::uint64_t i = 0; i < 40; ++i) none += changed(noisy(1000 + 2 * i), noisy(1001 + 2 * i)).empty();
  EXPECT_GE(none, 38);
}

// Stages of some microseconds, which vary by half from one build's run to the next, do not hide a change. Control seen:
// what all stages have in common taken over these too (4 of 20 found).
TEST(Against, ShortStagesSayNothingOfTheMachine) {
  int found = 0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    std::vector<CaptureRun> before = noisy(3000 + 2 * i), now = noisy(3001 + 2 * i, "foam", 1.1);
    for (std::vector<CaptureRun>* side : {&before, &now})
      for (CaptureRun& run : *side)
        for (CaptureFrame& frame : run.frames)
          for (std::size_t k = 4; k < stages.size(); ++k) frame.stage_ms[k] *= side == &before ? 0.03 : 0.02;
    found += changed(before, now) == std::vector<std::string>{"cpu_foam_ms"};
  }
  EXPECT_GE(found, 15);
}

// The file has the same runs as the program.
TEST(Against, ReadsWhatCaptureWrites) {
  const std::vector<CaptureRun> runs = noisy(5, "", 1.0, 3);
  const std::vector<CaptureRun> read = parse_capture_csv(capture_csv(runs), "a");
  ASSERT_EQ(read.size(), 3u);
  for (std::size_t r = 0; r < read.size(); ++r) {
    EXPECT_EQ(read[r].stage_names, runs[r].stage_names);
    ASSERT_EQ(read[r].frames.size(), runs[r].frames.size());
    for (std::size_t k = 0; k < read[r].stage_names.size(); ++k)
      EXPECT_NEAR(read[r].frames[40].stage_ms[k], runs[r].frames[40].stage_ms[k], 5.1e-5);
  }
}

TEST(Against, TellsFasterAndTogether) {
  const std::vector<CaptureRun> before = noisy(7);
  std::vector<CaptureRun> now = before;
  for (CaptureRun& run : now)
    for (CaptureFrame& frame : run.frames)
      for (std::size_t k = 0; k < frame.stage_ms.size(); ++k) frame.stage_ms[k] *= k == 3 ? 1.0 : 2.0;
  const std::string text = tell_changes(compare_captures(before, now));
  EXPECT_THAT(text, HasSubstr("storm / high: 100 frames, all stages together 2.00 of before\n"));
  EXPECT_THAT(text, HasSubstr("storm / high: cpu_foam_ms -50.0 % beyond that ("));
  EXPECT_THAT(tell_changes(compare_captures(before, before)),
              HasSubstr("storm / high: no stage has changed by more than its noise\n"));
  for (CaptureRun& run : now) run.preset = "low";
  EXPECT_THAT(tell_changes(compare_captures(before, now)), HasSubstr("nothing to compare"));
}

// Captures of other pictures are compared, but that is said. Controls seen: neither times nor triangles looked at;
// times alone.
TEST(Against, OtherPicturesAreSaid) {
  const auto with = [](double fps, std::uint64_t triangles) {
    std::vector<CaptureRun> runs = noisy(11, "", 1.0, 3);
    for (CaptureRun& run : runs)
      for (CaptureFrame& frame : run.frames) frame.time_s = frame.frame / fps, frame.triangles = triangles;
    return parse_capture_csv(capture_csv(runs), "a");
  };
  const auto told = [&](const std::vector<CaptureRun>& now) {
    return tell_changes(compare_captures(with(30.0, 1000), now));
  };
  EXPECT_THAT(told(with(30.0, 1015)), testing::Not(HasSubstr("other pictures")));
  EXPECT_THAT(told(with(7.0, 1000)),
              HasSubstr("storm / high: these are other pictures than before (frame 1 at 0.142857 s, 0.033333 before); "
                        "capture both with the same --size"));
  EXPECT_THAT(told(with(30.0, 1030)), HasSubstr("(1030 triangles a frame, 1000 before)"));
}

// A stage that is never there, frames that a run lacks, too few runs.
TEST(Against, LittleIsNoFault) {
  std::vector<CaptureRun> before = noisy(8);
  const std::vector<CaptureRun> now = noisy(9);
  before[3].frames.resize(5);
  EXPECT_EQ(compare_captures(before, now).at(0).frames, 5);
  before[3].frames.clear();
  EXPECT_EQ(compare_captures(before, now).at(0).frames, 0);
  before = noisy(8);
  for (CaptureRun& run : before)
    for (CaptureFrame& frame : run.frames) frame.stage_ms[0] = 0.0;
  EXPECT_EQ(compare_captures(before, now).at(0).stages.size(), stages.size() - 1);
  EXPECT_NO_THROW(expect_repeats(before, "old.csv"));
  before.resize(2);
  EXPECT_THROW(expect_repeats(before, "old.csv"), Error);
}

TEST(Against, FaultsNameTheLine) {
  const std::string good = capture_csv(noisy(1, "", 1.0, 1));
  const std::string head = good.substr(0, good.find('\n') + 1);
  const auto fault = [](const std::string& text) {
    try {
      (void)parse_capture_csv(text, "old.csv");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(fault(good), "none");
  EXPECT_THAT(fault(""), HasSubstr("old.csv: holds no frames"));
  EXPECT_THAT(fault("x,z\n1,2\n"), HasSubstr("old.csv:1: has not the columns of a capture"));
  EXPECT_THAT(fault(head.substr(0, head.find(",cpu_sea_ms")) + "\n"), HasSubstr("old.csv:1"));
  EXPECT_THAT(fault(head + "storm,high\n"), HasSubstr("old.csv:2: has 2 cells and not"));
  std::string word = good;
  word.replace(word.find("\nstorm,high,0") + 12, 1, "x");
  EXPECT_THAT(fault(word), HasSubstr("old.csv:2: frame: 'x' is not a number"));
}

}  // namespace
}  // namespace seascape
