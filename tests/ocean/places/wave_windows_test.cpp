// Windows of dynamic waves that move, jump, double and halve, and obstacles: what stays where it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/ocean/places/waves_support.h"
#include "tests/support/expect_error.h"
#include "tests/support/wake_truth.h"

namespace seascape {
namespace {

using waves_test::quiet;
using waves_test::Surface;

constexpr double dt = 1.0 / 60.0;

// A ring of waves around a place, some way out, of the given length of push.
void ring(DynamicWaves& waves, const LodPlacement& placement, glm::dvec2 middle, double length, int steps) {
  const WaveSource source{.place_m = middle, .length_m = length, .rise_mps = 1.0};
  for (int i = 0; i < 6; ++i) waves.advance(dt, placement, {&source, 1});
  for (int i = 0; i < steps; ++i) waves.advance(dt, placement, {});
}

// The greatest difference of two surfaces around a place, relative to the highest of the first.
double difference(const Surface& a, const Surface& b, glm::dvec2 middle, double reach) {
  double worst = 0.0, high = 0.0;
  for (double x = -reach; x <= reach; x += 0.21)
    for (double z = -reach; z <= reach; z += 0.23) {
      const std::complex<double> was = a.at(middle + glm::dvec2(x, z)), is = b.at(middle + glm::dvec2(x, z));
      high = std::max(high, std::abs(was));
      worst = std::max(worst, std::abs(was - is));
    }
  return worst / high;
}

// Two viewers, one that stays and one that glides by 4.8 m in a second: the waves between them are the same. Control
// seen: a border that stays where it was first (29 % off).
TEST(WaveWindows, WavesStayWhereTheyAreAsTheViewerMoves) {
  const DynamicWavesSettings s = quiet(128, 3, 0.125);
  DynamicWaves stays(s), glides(s);
  const LodPlacement start = lod_placement(s.windows, {1000000.3, 0.2}, {});
  for (DynamicWaves* waves : {&stays, &glides}) ring(*waves, start, {1000002.5, 0.0}, 1.5, 10);
  for (int i = 1; i <= 60; ++i) {
    stays.advance(dt, start, {});
    glides.advance(dt, lod_placement(s.windows, {1000000.3 + 0.08 * i, 0.2 - 0.03 * i}, {}), {});
  }
  const double off = difference(Surface(stays), Surface(glides), {1000002.5, 0.0}, 2.0);
  EXPECT_LT(off, 0.02);
}

// A viewer who jumps away finds calm water, not the waves of where he was. Control seen: a border that only absorbs by
// its rate (1.6e-5 m^2 left).
TEST(WaveWindows, AJumpTakesNoWavesAlong) {
  const DynamicWavesSettings s = quiet(64, 2, 0.25);
  DynamicWaves waves(s);
  ring(waves, lod_placement(s.windows, {0.0, 0.0}, {}), {0.0, 0.0}, 2.5, 10);
  const double before = waves.energy_m2();
  waves.advance(dt, lod_placement(s.windows, {512.0, -1024.0}, {}), {});
  EXPECT_LT(waves.energy_m2(), 1e-9 * before);
  // Half a window away, half of it is kept at most.
  DynamicWaves near(s);
  ring(near, lod_placement(s.windows, {0.0, 0.0}, {}), {0.0, 0.0}, 2.5, 10);
  near.advance(dt, lod_placement(s.windows, {8.0, 0.0}, {}), {});
  EXPECT_LT(near.level(0).energy_m2(), 0.6 * before);
  EXPECT_GT(near.energy_m2(), 0.01 * before);
}

// Texels double, and halve again: waves that fit both stay as they are, to 1 and 3 % of the highest; beside one whose
// windows never change. Controls seen: nothing handed over (4.2 % each); half a texel forgotten (2.1 and 3.3 %).
TEST(WaveWindows, AChangeOfScaleKeepsWhatFits) {
  const DynamicWavesSettings s = quiet(128, 3, 0.125);
  const glm::dvec2 middle(0.4, -0.3);
  DynamicWaves same(s), changes(s);
  const LodPlacement low = lod_placement(s.windows, {0.0, 0.0}, {}),
                     high = lod_placement(s.windows, {0.0, 0.0}, {1, 0.0});
  for (DynamicWaves* waves : {&same, &changes}) ring(*waves, low, middle, 6.0, 30);
  same.advance(dt, low, {});
  changes.advance(dt, high, {});
  ASSERT_EQ(changes.level(0).texel_m(), 0.25);
  const double up = difference(Surface(same), Surface(changes), middle, 4.5);
  same.advance(dt, low, {});
  changes.advance(dt, low, {});
  const double down = difference(Surface(same), Surface(changes), middle, 4.5);
  EXPECT_LT(up, 0.01);
  EXPECT_LT(down, 0.03);
}

// A group of waves 16 texels long runs against a wall two waves thick: a quarter of its height comes by (the level's
// band of waves is too narrow for a sharper shadow), a good part comes back. Control seen: a wall that is not looked at
// (all of it, nothing back).
TEST(WaveWindows, ObstaclesCastShadows) {
  const DynamicWavesSettings s = quiet(128, 2, 0.25);
  const LodPlacement placement = lod_placement(s.windows, {0.0, 0.0}, {});
  double behind[2] = {0.0, 0.0}, before[2] = {0.0, 0.0};
  for (int walled = 0; walled < 2; ++walled) {
    DynamicWaves waves(s);
    if (walled != 0) waves.set_obstacles([](glm::dvec2 p, double) { return std::abs(p.x) < 4.0 ? 0.0f : 1.0f; });
    waves_test::launch(waves, 0, {-7.0, 0.0}, 4.0, 0.0, 1.5, 0.1);
    for (int i = 0; i < 900; ++i) {
      waves.advance(dt, placement, {});
      if (i % 10 != 0) continue;
      const Surface surface(waves);
      behind[walled] = std::max(behind[walled], std::abs(surface.at({7.0, 0.0})));
      if (i > 400) before[walled] = std::max(before[walled], std::abs(surface.at({-7.0, 0.0})));
    }
  }
  EXPECT_LT(behind[1], 0.3 * behind[0]);
  EXPECT_GT(before[1], 3.0 * before[0]);
}

// Controls seen: as the tests of FaultsOfSettingsAreNamed.
TEST(WaveWindows, DepthIsALevelsOwn) {
  DynamicWaves waves(quiet(64, 2, 0.25));
  waves.set_depth(1, 2.0);
  EXPECT_EQ(waves.level(1).depth_m(), 2.0);
  EXPECT_EQ(waves.level(0).depth_m(), 1e6);
  EXPECT_NE(test::error_of([&] { waves.set_depth(0, std::nan("")); }).find("depth_m"), std::string::npos);
  const LodPlacement placement = lod_placement(waves.settings().windows, {0.0, 0.0}, {});
  waves.set_depth(0, -1.0);
  const WaveSource source{.length_m = 2.0, .rise_mps = 1.0};
  waves.advance(0.1, placement, {&source, 1});
  EXPECT_EQ(waves.level(0).energy_m2(), 0.0) << "dry";
  EXPECT_GT(waves.level(1).energy_m2(), 0.0);
}

}  // namespace
}  // namespace seascape
