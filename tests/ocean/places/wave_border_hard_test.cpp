// Groups of waves that run over the borders of windows: what comes back, and what goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/ocean/places/waves_support.h"
#include "tests/support/sanitized.h"
#include "tests/support/wake_truth.h"

namespace seascape {
namespace {

using waves_test::launch;

double airy_speed(double wave_m) { return 0.5 * std::sqrt(9.81 * wave_m / (2.0 * truth::pi)); }

// The energy that is left in a level, of a whole group's, when the group would be one and a quarter windows away: what
// its border gave back and what came round.
double left(int level, double texels, double angle) {
  const DynamicWavesSettings s = waves_test::quiet(256, 2, 0.125);
  DynamicWaves waves(s);
  const double texel = waves.level(level).texel_m(), side = 256 * texel, width = 20.0 * texel;
  launch(waves, level, {0.0, 0.0}, texels * texel, angle, width, 0.1);
  const double whole = 0.01 * truth::pi * width * width / (side * side);
  const int steps = int(1.25 * side / airy_speed(texels * texel) * s.rate_hz);
  for (int i = 0; i < steps; ++i) waves.advance(1.0 / s.rate_hz, lod_placement(s.windows, {0.0, 0.0}, {}), {});
  return waves.level(level).energy_m2() / whole;
}

// Less than 0.5 % of the energy for all levels but the coarsest (truths.md, hard case 30, asks for 1 %), straight on
// and aslant; of the coarsest 0.5 % up to 32 texels a wave and 2 % at 50, beyond which its share of waves ends.
// Controls seen: no border (90, 100 and 54 % left); one twenty times as strong (0.76, 1.9 and 4.6 %).
TEST(WaveBorder, hard_30_a_border_gives_little_back) {
  if (test::sanitized) GTEST_SKIP() << "thousands of the steps that the other tests take";
  double fine = 0.0, coarse = 0.0, longest = 0.0;
  for (const double texels : {10.0, 16.0, 20.0}) fine = std::max(fine, left(0, texels, 0.0));
  fine = std::max(fine, left(0, 16.0, 0.6));
  for (const double texels : {16.0, 32.0}) coarse = std::max(coarse, left(1, texels, 0.0));
  longest = left(1, 50.0, 0.0);
  EXPECT_LT(fine, 0.005);
  EXPECT_LT(coarse, 0.005);
  EXPECT_LT(longest, 0.02);
}

// A group of waves of 20 texels, which two levels share, runs out of the finer one's window: within it less than 0.5 %
// of the energy stays behind, and the coarser level's share goes on as if nothing was there. Control seen: no border
// (93 % within).
TEST(WaveBorder, AGroupCrossesToTheCoarserLevel) {
  const DynamicWavesSettings s = waves_test::quiet(256, 2, 0.125);
  DynamicWaves waves(s);
  const double wave_m = 20.0 * 0.125, speed = airy_speed(wave_m), dt = 1.0 / s.rate_hz;
  for (int i = 0; i < 2; ++i) launch(waves, i, {2.0, 0.0}, wave_m, 0.0, 3.0, 0.1);
  const auto inside = [&] {
    const waves_test::Surface surface(waves);
    double sum = 0.0;
    for (double x = -12.0; x < 12.0; x += 0.25)
      for (double z = -12.0; z < 12.0; z += 0.25) sum += std::norm(surface.at({x, z}, 0.0));
    return sum;
  };
  const double before = inside();
  EXPECT_NEAR(std::abs(waves_test::Surface(waves).at({2.0, 0.0})), 0.1, 0.006) << "both levels together";
  const int steps = int(21.0 / speed / dt);
  for (int i = 0; i < steps; ++i) waves.advance(dt, lod_placement(s.windows, {0.0, 0.0}, {}), {});
  // The group's middle is now at 23 m, beyond the fine window's 16; the coarse border begins at 24.
  const waves_test::Surface surface(waves);
  double best = 0.0, at = 0.0, behind = 0.0;
  for (double x = 10.0; x < 30.0; x += 0.1)
    if (const double here = std::abs(surface.at({x, 0.0}, 0.0)); here > best) best = here, at = x;
  for (double x = -12.0; x < 8.0; x += 0.25)
    for (double z = -12.0; z < 12.0; z += 0.25) behind += std::norm(surface.at({x, z}, 0.0));
  EXPECT_LT(behind, 0.005 * before);
  EXPECT_NEAR(at, 23.0, 1.0);
}

}  // namespace
}  // namespace seascape
