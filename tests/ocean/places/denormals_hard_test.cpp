// Numbers below what processors are fast with: whatever dies away ends at 0 before it comes to them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ocean/foam/foam.h"
#include "ocean/places/dynamic_waves.h"
#include "ocean/waves/wave_tiles.h"

namespace seascape {
namespace {

template <class Number>
bool denormal(Number value) {
  return std::fpclassify(value) == FP_SUBNORMAL;
}

// Hard 33: Denormals, which make a step many times as long, are counted instead of timed: foam that dies away has none
// at any step, dynamic waves have none in their modes and in less than 1 % of their texels while they fall from 1 m
// through 1e-30 m, and tiles of a sea of 1 mm/s of wind have less than 1 %. Control: foam that is not cut off
// below 6.2e-5 has nothing else after 90 s, and waves that are not cleared at 1e-30 m after 3 minutes.
TEST(DenormalsHard, hard_33_what_dies_away_ends_at_0) {
  FoamSettings f;
  f.windows = {.resolution = 32, .slices = 2, .texel_m = 0.5};
  f.life_s = 1.0;
  Foam foam(f);
  foam.follow(lod_placement(f.windows, {0.0, 0.0}, {}), 0.0f);
  foam.fill(1.0f);
  for (int i = 0; i < 1200; ++i) {
    foam.step(0.1, nullptr);
    for (int slice = 0; slice < 2; ++slice)
      foam.field().each(slice, [&](LodIndex w) { ASSERT_FALSE(denormal(foam.field().texel(slice, w))) << i; });
  }
  EXPECT_FALSE(foam.any());

  DynamicWavesSettings s;
  s.windows = {.resolution = 64, .slices = 2, .texel_m = 0.25};
  s.damping_per_s = 4.0;
  s.idle_m = 0.0;
  DynamicWaves waves(s);
  const LodPlacement placement = lod_placement(s.windows, {0.0, 0.0}, {});
  waves.advance(0.5, placement, std::vector<WaveSource>{{.length_m = 3.0, .head_m = 1.0}});
  std::size_t texels = 0, slow = 0;
  std::vector<float> height(64 * 64), quarter(64 * 64);
  int steps = 0;
  for (; steps < 4000 && waves.energy_m2() > 0.0; ++steps) {
    waves.advance(1.0 / s.rate_hz, placement, {});
    for (int i = 0; i < waves.levels(); ++i) {
      for (const std::complex<double>& mode : std::as_const(waves).level(i).modes())
        ASSERT_FALSE(denormal(mode.real()) || denormal(mode.imag())) << steps;
      if (steps % 20 != 0) continue;
      std::as_const(waves).level(i).surface(height, quarter);
      for (const float h : height) ++texels, slow += denormal(h);
    }
  }
  EXPECT_LT(steps, 4000);
  EXPECT_EQ(waves.energy_m2(), 0.0);
  EXPECT_LT(double(slow), 0.01 * double(texels));

  for (const double wind : {1e-3, 0.01, 0.5}) {
    SeaState sea;
    sea.wind_speed_mps = wind;
    const WaveField field(sea, {.resolution = 64, .cascades = 4});
    WaveTiles tiles;
    field.evaluate(12345, tiles);
    std::size_t all = 0, small = 0;
    for (int c = 0; c < 4; ++c)
      for (int z = 0; z < tiles.samples(c); ++z)
        for (int x = 0; x < tiles.samples(c); ++x) {
          const glm::vec4 t = tiles.texels(c, WavePlane::shift, 0)[z * tiles.stride(c, 0) + x];
          for (int i = 0; i < 4; ++i) ++all, small += denormal(t[i]);
        }
    EXPECT_LT(double(small), 0.01 * double(all)) << wind;
  }
}

}  // namespace
}  // namespace seascape
