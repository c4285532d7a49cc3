// The surface of dynamic waves: a wave's orbit and slopes, written down directly, and that it never cuts itself.
#include "ocean/places/dynamic_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/ocean/places/waves_support.h"
#include "tests/support/wake_truth.h"

namespace seascape {
namespace {

using waves_test::quiet;

// One wave of 24 texels (two at once: it has an opposite that runs the other way) on a level, at texels: a Gerstner
// wave's orbits, coth(k h) as wide as high. Controls seen: the shift turned round; the opposite wave forgotten; the
// depth left out (6 mm).
TEST(DynamicSurface, HasAWavesOrbitAndSlopes) {
  for (const double depth : {0.4, 1e6}) {
    DynamicWavesSettings s = quiet(128, 2, 0.125);
    s.depth_m = depth;
    DynamicWaves waves(s);
    DynamicSurface surface(s);
    const int band = 32, mx = 5, mz = -3;
    const double side = 16.0, kx = 2.0 * truth::pi * mx / side, kz = 2.0 * truth::pi * mz / side,
                 k = std::hypot(kx, kz), a = 0.02;
    waves.level(0).modes()[std::size_t((mz + band / 2) * band + mx + band / 2)] = a;
    ASSERT_GT(waves.level(0).share()[std::size_t((mz + band / 2) * band + mx + band / 2)], 0.0);
    surface.evaluate(waves);
    EXPECT_EQ(surface.share(), 1.0);
    const double width = 1.0 / std::tanh(k * depth);
    for (int i = 0; i < 50; ++i) {
      const glm::dvec2 p = (glm::dvec2((i * 7) % 40 - 20, (i * 11) % 40 - 20) + 0.5) * 0.125;
      const double phase = kx * (p.x - 0.0625) + kz * (p.y - 0.0625);
      const DynamicSample is = surface.sea(p, 0.0);
      EXPECT_NEAR(is.displacement.y, a * std::cos(phase), 1e-6);
      EXPECT_NEAR(is.displacement.x, -a * width * kx / k * std::sin(phase), 1e-6);
      EXPECT_NEAR(is.displacement.z, -a * width * kz / k * std::sin(phase), 1e-6);
      EXPECT_NEAR(is.height_gradient.x, -a * kx * std::sin(phase), 3e-6);
      EXPECT_NEAR(is.height_gradient.y, -a * kz * std::sin(phase), 3e-6);
      EXPECT_NEAR(is.shift_gradient.x, -a * width * kx * kx / k * std::cos(phase), 3e-6);
      EXPECT_NEAR(is.shift_gradient.y, -a * width * kz * kz / k * std::cos(phase), 3e-6);
      EXPECT_NEAR(is.shift_gradient.z, -a * width * kx * kz / k * std::cos(phase), 3e-6);
      EXPECT_EQ(surface.sea(p, 1.0).displacement, glm::dvec3(0.0)) << "eight texels";
    }
  }
}

// Pushed far beyond what water bears, on all levels at once: the surface's own I + grad D, by differences of what is
// drawn, keeps squeezing less than all of it everywhere. Least seen: 0.43 of 1. Control seen: a share of 1 always
// (-4.6).
TEST(DynamicSurface, NeverCutsItself) {
  DynamicWavesSettings s = quiet(64, 3, 0.25);
  s.sharpening = 2.0;
  DynamicWaves waves(s);
  DynamicSurface surface(s);
  const LodPlacement placement = lod_placement(s.windows, {0.3, -0.2}, {});
  double least = 1.0, least_share = 1.0, unlimited = 1.0;
  for (int n = 0; n < 30; ++n) {
    const WaveSource sources[] = {
        {.place_m = {0.11 * n - 2.0, 0.3}, .velocity_mps = {6.6, 0.0}, .length_m = 2.5, .head_m = 8.0},
        {.place_m = {1.0, -0.2 * n}, .length_m = 4.0, .rise_mps = 20.0}};
    waves.advance(1.0 / 60.0, placement, sources);
    if (n % 10 != 9) continue;
    surface.evaluate(waves);
    least_share = std::min(least_share, surface.share());
    constexpr double e = 1e-4;
    for (double x = -12.0; x < 12.0; x += 0.11)
      for (double z = -12.0; z < 12.0; z += 0.13) {
        const auto shift = [&](double px, double pz) { return surface.sea({px, pz}, 0.0).displacement; };
        const glm::dvec3 middle = shift(x, z), dx = (shift(x + e, z) - middle) / e, dz = (shift(x, z + e) - middle) / e;
        // Positive definite: of every direction v, v.(I + grad D) v is above 0.
        const double xx = dx.x, zz = dz.z, xz = 0.5 * (dx.z + dz.x),
                     low = 0.5 * (xx + zz) - std::hypot(0.5 * (xx - zz), xz);
        least = std::min(least, 1.0 + low);
        unlimited = std::min(unlimited, 1.0 + low / surface.share());
      }
  }
  EXPECT_LT(unlimited, -0.5) << "it would have";
  EXPECT_GT(least, 0.02);
}

// At rest there is nothing, and nothing is left of what was. Control seen: planes of a level that rests are read (0.006
// m).
TEST(DynamicSurface, IsFlatAtRest) {
  DynamicWavesSettings s = quiet(64, 2, 0.25);
  s.idle_m = 0.02, s.damping_per_s = 2.0;
  DynamicWaves waves(s);
  DynamicSurface surface(s);
  const LodPlacement placement = lod_placement(s.windows, {0.0, 0.0}, {});
  const WaveSource source{.place_m = {0.0, 0.0}, .length_m = 3.0, .rise_mps = 1.0};
  waves.advance(0.1, placement, {&source, 1});
  surface.evaluate(waves);
  EXPECT_GT(std::abs(surface.sea({0.2, 0.1}, 0.0).displacement.y), 1e-3);
  for (int i = 0; i < 3600 && waves.active(); ++i) waves.advance(1.0 / 60.0, placement, {});
  ASSERT_FALSE(waves.active());
  surface.evaluate(waves);
  EXPECT_EQ(surface.sea({0.2, 0.1}, 0.0).displacement, glm::dvec3(0.0));
}

}  // namespace
}  // namespace seascape
