#include "app/against.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/error.h"

namespace seascape {
namespace {

using testing::HasSubstr;

const std::vector<std::string> stages{"sea", "waves", "places", "foam", "spray", "traversal", "recording", "submission"};

// A capture whose times vary as on a machine that others use: a speed of its own that drifts, stages that vary by
// themselves, some frames that take several times as long, and a stage that is some per cent off for as long as the
// process lives.
CaptureRun noisy(std::uint64_t seed, const std::string& slower = "", double by = 1.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> any;
  CaptureRun run;
  run.scene = "storm";
  run.preset = "high";
  run.stage_names = stages;
  run.stage_names.push_back("waiting");
  const double speed = std::exp(0.3 * normal(random));
  std::vector<double> of_process;
  for (std::size_t k = 0; k < stages.size(); ++k) of_process.push_back(std::exp(0.005 * normal(random)));
  double drift = 0.0;
  for (int i = 0; i < 300; ++i) {
    drift = 0.98 * drift + 0.02 * normal(random);
    CaptureFrame frame;
    frame.frame = i;
    for (std::size_t k = 0; k < stages.size(); ++k) {
      // What the stage has to do along the path, the same in both builds.
      const double work = (0.1 + 0.15 * double(k)) * (1.0 + 0.6 * std::sin(0.05 * i * double(k + 1)));
      double ms = work * speed * std::exp(drift + 0.06 * normal(random)) * of_process[k];
      if (any(random) < 0.02) ms *= 1.0 + 5.0 * any(random);
      if (stages[k] == slower) ms *= by;
      frame.stage_ms.push_back(ms);
      frame.cpu_ms += ms;
    }
    frame.stage_ms.push_back(5.0 * any(random));  // waiting
    run.frames.push_back(frame);
  }
  return run;
}

std::vector<std::string> changed(const CaptureRun& before, const CaptureRun& now) {
  const std::vector<RunChange> runs =
      compare_captures(parse_capture_csv(capture_csv({before}), "a"), parse_capture_csv(capture_csv({now}), "b"));
  std::vector<std::string> names;
  for (const TimeChange& time : runs.at(0).times)
    if (time.changed()) names.push_back(time.name);
  return names;
}

// Controls seen: what the times have in common left in (3 of 40 found); no least noise (35).
TEST(Against, FindsTenPerCentInOneStage) {
  int found = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const std::string& slower = stages[i % stages.size()];
    found += changed(noisy(2 * i), noisy(2 * i + 1, slower, 1.1)) == std::vector{"cpu_" + slower + "_ms"};
  }
  EXPECT_GE(found, 38);
}

// Control seen: what the times have in common left in (nothing in 12 of 40).
TEST(Against, FindsNothingBetweenTwoRunsOfOneBuild) {
  int none = 0;
  for (std::uint64_t i = 0; i < 40; ++i) none += changed(noisy(1000 + 2 * i), noisy(1001 + 2 * i)).empty();
  EXPECT_GE(none, 38);
}

TEST(Against, TellsFasterAndTogether) {
  CaptureRun before = noisy(7), now = before;
  for (CaptureFrame& frame : now.frames)
    for (std::size_t k = 0; k < frame.stage_ms.size(); ++k) frame.stage_ms[k] *= k == 3 ? 1.0 : 2.0;
  const std::string text = tell_changes(compare_captures({before}, {now}));
  EXPECT_THAT(text, HasSubstr("storm / high: 300 frames, all times together 2.00 of before\n"));
  EXPECT_THAT(text, HasSubstr("storm / high: cpu_foam_ms -50.0 % beyond that ("));
  EXPECT_THAT(tell_changes(compare_captures({before}, {before})),
              HasSubstr("storm / high: no stage and no pass has changed by more than its noise\n"));
  now.preset = "low";
  EXPECT_THAT(tell_changes(compare_captures({before}, {now})), HasSubstr("nothing to compare"));
}

// Short runs, a stage that is never there, frames that one side lacks.
TEST(Against, LittleIsNoFault) {
  CaptureRun before = noisy(8), now = noisy(9);
  before.frames.resize(5);
  EXPECT_EQ(compare_captures({before}, {now}).at(0).times.size(), 0u);  // fewer frames than pieces
  before.frames.clear();
  EXPECT_EQ(compare_captures({before}, {now}).at(0).frames, 0);
  before = noisy(8);
  for (CaptureFrame& frame : before.frames) frame.stage_ms[0] = 0.0;
  for (const TimeChange& time : compare_captures({before}, {now}).at(0).times) EXPECT_TRUE(std::isfinite(time.ratio));
}

TEST(Against, FaultsNameTheLine) {
  const std::string good = capture_csv({noisy(1)});
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
