// Which preset `auto` is: the walk over presets that are measured as it goes, and what is remembered of a device.
#include "app/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "tests/support/temporary_folder.h"

namespace seascape {
namespace {

struct Walk {
  std::size_t preset = 0;
  int measured = 0;
};

// Presets that take these times, measured when the walk asks for them.
Walk walk(const std::array<FrameCost, 4>& truth, std::size_t first, const FrameGoal& goal, Calibration known = {}) {
  Walk result;
  for (;;) {
    const AutoStep step = auto_step(known, first, goal);
    if (!step.measure) return {step.preset, result.measured};
    EXPECT_FALSE(known.presets[step.preset]) << "measured twice";
    known.presets[step.preset] = truth[step.preset];
    if (++result.measured > 4) return result;
  }
}

// Control: fits() against the whole period, or a walk that stops at its first preset that fits, fails here.
TEST(Calibration, TakesTheFinestPresetThatFits) {
  const std::array<FrameCost, 4> truth{{{1.0, 1.0}, {2.0, 2.0}, {4.0, 4.0}, {8.0, 8.0}}};
  for (std::size_t first = 0; first < 4; ++first) {
    EXPECT_EQ(walk(truth, first, {1.0, 100.0}).preset, 3u) << first;
    EXPECT_EQ(walk(truth, first, {1.0, 16.01 / share_of_period}).preset, 3u) << first;
    EXPECT_EQ(walk(truth, first, {1.0, 16.5}).preset, 2u) << first << ": a tenth of the period is kept";
    EXPECT_EQ(walk(truth, first, {1.0, 5.0}).preset, 1u) << first;
    EXPECT_EQ(walk(truth, first, {1.0, 3.0}).preset, 0u) << first;
    EXPECT_EQ(walk(truth, first, {1.0, 0.1}).preset, 0u) << first << ": nothing fits";
  }
}

// Control: a walk that measures low, to which there is no other choice, fails here.
TEST(Calibration, MeasuresNoMoreThanItNeeds) {
  const std::array<FrameCost, 4> truth{{{1.0, 1.0}, {2.0, 2.0}, {4.0, 4.0}, {8.0, 8.0}}};
  EXPECT_EQ(walk(truth, 1, {1.0, 0.1}).measured, 1);
  EXPECT_EQ(walk(truth, 3, {1.0, 100.0}).measured, 1);
  EXPECT_EQ(walk(truth, 2, {1.0, 12.0}).measured, 2);
  Calibration known;
  for (std::size_t p = 0; p < 4; ++p) known.presets[p] = truth[p];
  EXPECT_EQ(walk(truth, 3, {2.0, 40.0}, known).measured, 0) << "another size asks for nothing new";
}

// Control: a walk down that does not end where a preset fits goes round for ever here.
TEST(Calibration, EndsWhateverIsMeasured) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> ms(0.0, 20.0);
  for (int n = 0; n < 10000; ++n) {
    std::array<FrameCost, 4> truth;
    for (FrameCost& cost : truth) cost = {ms(random), ms(random)};  // a finer preset may be the quicker one
    const FrameGoal goal{1.0, ms(random)};
    const Walk ended = walk(truth, random() % 4, goal);
    ASSERT_LE(ended.measured, 4);
    const double fits_ms = share_of_period * goal.period_ms;
    EXPECT_TRUE(ended.preset == 0 || truth[ended.preset].at(1.0) <= fits_ms);
  }
}

// Control: a fixed part below 0 that is kept makes small pictures cost nothing here.
TEST(Calibration, TwoSizesGiveBothParts) {
  const FrameCost cost = cost_through(0.25, 3.0, 1.0, 6.0);
  EXPECT_NEAR(cost.fixed_ms, 2.0, 1e-12);
  EXPECT_NEAR(cost.ms_a_megapixel, 4.0, 1e-12);
  const FrameCost noisy = cost_through(0.25, 6.0, 1.0, 5.0);  // the larger one was quicker
  EXPECT_NEAR(noisy.fixed_ms, 5.0, 1e-12);
  EXPECT_EQ(noisy.ms_a_megapixel, 0.0);
  const FrameCost steep = cost_through(0.25, 1.0, 1.0, 8.0);
  EXPECT_EQ(steep.fixed_ms, 0.0);
  EXPECT_NEAR(steep.ms_a_megapixel, 8.0, 1e-12);
  EXPECT_EQ(cost_through(1e-6, 2.0, 1e-6, 3.0).fixed_ms, 3.0) << "a picture of one pixel";
}

// Control: a file whose name and text leave the driver out has another driver's times here.
TEST(Calibration, IsRememberedByDeviceAndDriver) {
  const test::TemporaryFolder folder;
  const DiskCache cache(folder.path());
  Calibration known;
  known.presets[1] = FrameCost{2.5, 0.75};
  remember(cache, {"GPU \"9\"", "driver 1"}, known);
  const Calibration again = remembered(cache, {"GPU \"9\"", "driver 1"});
  ASSERT_TRUE(again.presets[1]);
  EXPECT_EQ(again.presets[1]->fixed_ms, 2.5);
  EXPECT_EQ(again.presets[1]->ms_a_megapixel, 0.75);
  EXPECT_FALSE(again.presets[0]);
  EXPECT_FALSE(remembered(cache, {"GPU \"9\"", "driver 2"}).presets[1]);
  EXPECT_FALSE(remembered(DiskCache(), {"GPU \"9\"", "driver 1"}).presets[1]);
}

// Control: remembered() without its checks of numbers takes the times below 0.
TEST(Calibration, DamagedFilesAreAsNone) {
  const test::TemporaryFolder folder;
  const DiskCache cache(folder.path());
  Calibration known;
  known.presets[0] = FrameCost{-1.0, 1.0};
  known.presets[2] = FrameCost{1.0, std::nan("")};
  known.presets[3] = FrameCost{1.0, 1.0};
  remember(cache, {"a", "b"}, known);
  const Calibration again = remembered(cache, {"a", "b"});
  EXPECT_FALSE(again.presets[0]);
  EXPECT_FALSE(again.presets[2]);
  EXPECT_TRUE(again.presets[3]);
  for (const auto& file : std::filesystem::directory_iterator(folder.path()))
    std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) / 2);
  EXPECT_FALSE(remembered(cache, {"a", "b"}).presets[3]);
}

// Control: presets that are not measured told too.
TEST(Calibration, TellsWhatIsKnown) {
  Calibration known;
  EXPECT_EQ(calibration_text(known), "not measured");
  known.presets[2] = FrameCost{1.25, 0.5};
  EXPECT_EQ(calibration_text(known), "high 1.25 ms and 0.50 ms a megapixel");
}

}  // namespace
}  // namespace seascape
