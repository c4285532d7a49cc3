// The surface of dynamic waves: a wave's orbit and slopes, written down directly, and that it never cuts itself.
#include "ocean/places/dynamic_surface.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

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

// Waves from all sides on every level.
void stir(DynamicWaves& waves, double strength = 1.0) {
  const LodPlacement placement = lod_placement(waves.settings().windows, {0.3, -0.2}, {});
  const WaveSource sources[] = {
      {.place_m = {0.4, 0.3}, .velocity_mps = {2.0, 0.0}, .length_m = 0.8, .head_m = 0.1 * strength},
      {.place_m = {-1.0, 0.9}, .velocity_mps = {0.0, -1.0}, .length_m = 2.2, .rise_mps = 0.2 * strength},
      {.place_m = {-0.2, -0.7}, .length_m = 1.3, .head_m = -0.06 * strength},
  };
  for (int n = 0; n < 25; ++n) waves.advance(1.0 / waves.settings().rate_hz, placement, sources);
}

// What a level's texels come to is what its planes say, found again texel by texel; the share is what they leave of the
// sharpening. Controls seen: what lies east of a strip's last column left at 0 (bent by half as much again), what lies
// north left out, half of the rows left out of a moment, the squeeze without the gradient's product.
TEST(DynamicSurface, TexelsComeToWhatPlanesSay) {
  DynamicWavesSettings s = quiet(64, 3, 0.1);
  s.sharpening = 2.0;
  DynamicWaves waves(s);
  stir(waves, 4.0);
  DynamicSurface surface(s);
  surface.evaluate(waves);
  double squeezed = 0.0;
  for (int level = 0; level < 3; ++level) {
    ASSERT_FALSE(surface.still(level));
    const auto shift = surface.shift(level), slope = surface.slope(level);
    DynamicSurface::Extent most;
    double squeeze = 0.0;
    for (std::size_t z = 0; z < 64; ++z)
      for (std::size_t x = 0; x < 64; ++x) {
        const glm::dvec4 d = shift[z * 64 + x], g = slope[z * 64 + x], east = slope[z * 64 + (x + 1) % 64],
                         north = slope[(z + 1) % 64 * 64 + x];
        most.height_m = std::max(most.height_m, std::abs(d.y));
        most.shift_m = std::max(most.shift_m, std::hypot(d.x, d.z));
        most.bent_per_m = std::max(most.bent_per_m, std::hypot(glm::length(glm::dvec2(east) - glm::dvec2(g)),
                                                               glm::length(glm::dvec2(north) - glm::dvec2(g))));
        most.slope_moments += glm::dvec3(g.x * g.x, g.y * g.y, g.x * g.y) / 4096.0;
        squeeze = std::max(squeeze, std::hypot(0.5 * (g.z - g.w), d.w) - 0.5 * (g.z + g.w));
      }
    const DynamicSurface::Extent is = surface.extent(level);
    EXPECT_NEAR(is.height_m, most.height_m, 1e-6 * most.height_m);
    EXPECT_NEAR(is.shift_m, surface.share() * most.shift_m, 1e-6 * most.shift_m);
    EXPECT_NEAR(is.bent_per_m, most.bent_per_m / surface.texel_m(level), 1e-5 * is.bent_per_m);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(is.slope_moments[i], most.slope_moments[i], 1e-5 * most.slope_moments.x) << i;
    squeezed += squeeze + most.shift_m / (gpu::lod_border * surface.windows({}).reach.x * std::exp2(level));
  }
  EXPECT_GT(squeezed, 0.8) << "the share is put to the test";
  EXPECT_NEAR(surface.share() * squeezed, 0.8, 1e-5);
}

// Steps and surface are the same to the bit with every vector instruction set of this processor. Control seen: one
// multiply-add in place of a product and a sum, in the spectra or in what a border takes.
TEST(DynamicSurface, BitsDoNotDependOnTheInstructionSet) {
  const DynamicWavesSettings s = quiet(128, 2, 0.1);
  std::vector<std::vector<glm::vec4>> best;
  std::vector<DynamicSurface::Extent> extents;
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    DynamicWaves waves(s);
    stir(waves);
    DynamicSurface surface(s);
    surface.evaluate(waves, 0.013, true);
    std::vector<std::vector<glm::vec4>> planes;
    for (int i = 0; i < 2; ++i) {
      for (const auto plane : {surface.shift(i), surface.slope(i), surface.velocity(i)})
        planes.emplace_back(plane.begin(), plane.end());
      extents.push_back(surface.extent(i));
      const DynamicSurface::Extent &is = extents.back(), &was = extents[std::size_t(i)];
      EXPECT_EQ(is.height_m, was.height_m);
      EXPECT_EQ(is.shift_m, was.shift_m);
      EXPECT_EQ(is.bent_per_m, was.bent_per_m);
      EXPECT_EQ(is.slope_moments, was.slope_moments);
    }
    if (best.empty()) best = planes;
    for (std::size_t i = 0; i < planes.size(); ++i)
      EXPECT_EQ(std::memcmp(planes[i].data(), best[i].data(), planes[i].size() * sizeof(glm::vec4)), 0)
          << hwy::TargetName(left & -left) << " plane " << i;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
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
