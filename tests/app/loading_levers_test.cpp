// What a scene is loaded with: presets and samples as levers, and what is known of a scene before it is there.
#include "app/adaptive/loading_levers.h"

#include <gtest/gtest.h>

#include "app/adaptive/rate_keeper.h"
#include "app/loading_range.h"

namespace seascape {
namespace {

LoadingRange range() { return {3, {2.0, 3.0, 6.0, 10.0}, {0.09, 0.07, 0.03, 0.01}, 4}; }

// Control: steps from low up fail here.
TEST(LoadingLevers, BeginWithTheFinestPreset) {
  const std::vector<Lever> levers = loading_levers(range());
  ASSERT_EQ(levers.size(), 2u);
  ASSERT_EQ(levers[0].steps.size(), 4u);
  EXPECT_EQ(levers[0].steps[0].value, 3.0);
  EXPECT_EQ(levers[0].steps[0].error, 0.0);
  EXPECT_DOUBLE_EQ(levers[0].steps[3].work, 0.2);
  EXPECT_DOUBLE_EQ(levers[0].steps[3].error, 0.08);
  ASSERT_EQ(levers[1].steps.size(), 3u);
  EXPECT_EQ(levers[1].steps[2].value, 1.0);
  for (const Lever& lever : levers) EXPECT_EQ(lever.moves, LeverMoves::at_loading);
}

// Where low was measured slower than medium it is worth no more than medium. Control: work as it was measured.
TEST(LoadingLevers, WorkFallsAndErrorRises) {
  LoadingRange odd = range();
  odd.preset_ms = {4.0, 3.0, 6.0, 5.0};
  odd.preset_error = {0.05, 0.07, 0.03, 0.04};
  const Lever presets = loading_levers(odd)[0];
  for (std::size_t i = 1; i < presets.steps.size(); ++i) {
    EXPECT_LE(presets.steps[i].work, presets.steps[i - 1].work);
    EXPECT_GE(presets.steps[i].error, presets.steps[i - 1].error);
  }
  EXPECT_DOUBLE_EQ(presets.steps[3].work, 0.6);
}

// Control: set_loaded() that takes a step's number for a preset's.
TEST(LoadingLevers, LevelsAndWhatIsLoadedAreOneAnothersInverse) {
  std::vector<Lever> levers = live_levers({});
  for (Lever& one : loading_levers(range())) levers.push_back(one);
  for (std::size_t preset = 0; preset < 4; ++preset)
    for (const int samples : {1, 2, 4}) {
      LeverLevels levels{};
      set_loaded(levers, {preset, samples}, levels);
      EXPECT_EQ(loaded_with(levers, levels), (LoadedWith{preset, samples}));
    }
  EXPECT_FALSE(loaded_with(live_levers({}), LeverLevels{}));
}

// `whole`: every frame is drawn at its finest, as for a screenshot.
LoadedWith loaded_after(double frame_ms, double ratio, std::size_t at_preset, bool whole = false) {
  std::vector<Lever> levers = live_levers({});
  for (Lever& one : loading_levers(range())) levers.push_back(one);
  LeverLevels start{};
  set_loaded(levers, {at_preset, 4}, start);
  RateKeeper keeper(levers, start);
  AdaptiveSettings settings;
  for (std::uint64_t n = 1; n < 60; ++n) {
    const DrawnQuality q = whole ? DrawnQuality{} : keeper.quality();
    const double ms = frame_ms * (0.5 + 0.5 * q.scale * q.scale);
    keeper.decide({.period_ms = 11.1, .timed_frame = n - 1, .gpu_ms = ms}, settings);
    keeper.drawn({.number = n, .cpu_ms = 1.0, .end_ms = 0.1, .whole = whole});
  }
  return keeper.for_scene(ratio, 1.0).value();
}

// A scene that will not fit is loaded at a lower preset or with fewer samples, one that leaves time at a finer one.
// Controls: a keeper that takes its levels for the finest (drawn() without loaded()), and a ratio that is left out.
TEST(LoadingLevers, ScenesAreLoadedWithWhatHoldsTheRate) {
  EXPECT_EQ(loaded_after(9.0, 1.0, 3), (LoadedWith{3, 4}));
  const LoadedWith heavy = loaded_after(9.0, 4.0, 3);
  EXPECT_TRUE(heavy.preset < 3 || heavy.samples < 4);
  EXPECT_EQ(loaded_after(1.0, 1.0, 0), (LoadedWith{3, 4})) << "low at 1 ms: ultra takes 5";
  for (const bool whole : {false, true})
    EXPECT_LT(loaded_after(9.0, 1.0, 0, whole).preset, 3u) << "low at 9 ms: ultra takes 45";
}

PresetCosts costs(const std::string& scene, std::array<double, 4> gpu) {
  return {scene,        "a device",
          "2026-11-28", 480,
          504,          2,
          24,           {{std::string(error_row), "", {0.09, 0.07, 0.03, 0.01}}, {std::string(gpu_row), "ms", gpu}}};
}

// Control: calibrated times that leave a preset out are not to be mixed with the table's.
TEST(LoadingRange, TimesAreTheDevicesOrTheTables) {
  const std::vector<PresetCosts> table{costs("open_sea", {2, 3, 6, 10}), costs("storm", {4, 6, 12, 20})};
  Calibration known;
  known.presets[0] = FrameCost{1.0, 1.0};
  known.presets[1] = FrameCost{1.0, 2.0};
  EXPECT_EQ(loading_range(table, "storm", known, 2.0, 1, 4)->preset_ms[1], 5.0);
  EXPECT_EQ(loading_range(table, "storm", known, 2.0, 3, 4)->preset_ms[1], 6.0);
  EXPECT_EQ(loading_range(table, "a new one", {}, 2.0, 3, 4)->preset_ms[1], 3.0);
  EXPECT_EQ(loading_range(table, "storm", {}, 2.0, 3, 4)->preset_error[2], 0.03);
  EXPECT_FALSE(loading_range({}, "storm", known, 2.0, 3, 4));
}

// Control: the ratio the other way round.
TEST(LoadingRange, ScenesAreComparedByTheTable) {
  const std::vector<PresetCosts> table{costs("open_sea", {2, 3, 6, 10}), costs("storm", {4, 6, 12, 30})};
  EXPECT_EQ(scene_ratio(table, "open_sea", "storm", 3), 3.0);
  EXPECT_EQ(scene_ratio(table, "storm", "open_sea", 0), 0.5);
  EXPECT_EQ(scene_ratio(table, "storm", "a new one", 0), 1.0);
}

}  // namespace
}  // namespace seascape
