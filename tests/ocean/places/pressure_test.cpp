// Inputs that press on dynamic waves: the same waves as a source of that shape makes, wakes of what moves, and nothing
// where they are not.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "ocean/places/dynamic_sea.h"

namespace seascape {
namespace {

DynamicWavesSettings small_waves() {
  DynamicWavesSettings s;
  s.windows = {.resolution = 64, .slices = 3, .texel_m = 0.25};
  return s;
}
InputBounds all() {
  InputBounds bounds;
  bounds.add(glm::dvec2(-1e6)), bounds.add(glm::dvec2(1e6));
  return bounds;
}
double height(const DynamicSurface& surface, glm::dvec2 at) { return surface.sea(at, 0.0).displacement.y; }

// A Gaussian that moves, given texel by texel, raises the waves of a source of that Gaussian within 4 % of the highest
// (its squares of 2 m, on the coarsest level, are no Gaussian). Controls seen: the scale of the Fourier sum left out;
// squares laid half a texel off (5 %).
TEST(Pressure, MovesTheWaterAsASourceOfItsShape) {
  constexpr double length = 5.0, speed = 3.0, pi = std::numbers::pi;
  DynamicWaves by_source(small_waves()), by_texels(small_waves());
  DynamicSurface source_surface(small_waves()), texel_surface(small_waves());
  const LodPlacement place = lod_placement(small_waves().windows, {0.0, 0.0}, {});
  const double dt = 1.0 / 60.0;
  for (int i = 0; i < 120; ++i) {
    const glm::dvec2 end(-3.0 + speed * dt * (i + 1), 0.0), middle = end - glm::dvec2(0.5 * speed * dt, 0.0);
    const WaveSource source{.place_m = end, .velocity_mps = {speed, 0.0}, .length_m = length, .head_m = 0.05};
    by_source.advance(dt, place, {&source, 1});
    by_texels.advance(
        dt, place, {},
        [&](glm::dvec2 at, double) {
          const glm::dvec2 off = at - middle;
          return float(0.05 * std::exp(-pi * pi * glm::dot(off, off) / (length * length)));
        },
        all());
  }
  source_surface.evaluate(by_source);
  texel_surface.evaluate(by_texels);
  double highest = 0.0, off = 0.0;
  for (double z = -6.0; z <= 6.0; z += 0.37)
    for (double x = -6.0; x <= 6.0; x += 0.41) {
      highest = std::max(highest, std::abs(height(source_surface, {x, z})));
      off = std::max(off, std::abs(height(source_surface, {x, z}) - height(texel_surface, {x, z})));
    }
  EXPECT_GT(highest, 0.01);
  EXPECT_LT(off, 0.04 * highest);
}

// A pressure that is no number is none, told of once; waves stay finite.
TEST(Pressure, ThatIsNoNumberIsNoneAndToldOf) {
  DynamicWaves waves(small_waves());
  const LodPlacement place = lod_placement(small_waves().windows, {0.0, 0.0}, {});
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (int i = 0; i < 10; ++i)
      waves.advance(
          1.0 / 60.0, place, {}, [&](glm::dvec2 at, double) { return glm::length(at) < 2.0 ? bad : 0.001f; }, all());
    EXPECT_TRUE(waves.take_fault());
    EXPECT_TRUE(std::isfinite(waves.energy_m2()));
    EXPECT_GT(waves.energy_m2(), 0.0) << "what is a number pushes";
  }
}

std::shared_ptr<const Inputs> boat(double from_s, double to_s) {
  InputSpec spec;
  spec.to = InputTarget::dynamic_waves;
  spec.value.x = 0.08f;
  spec.feather_m = 0.8;
  spec.shape = TrailInput{.keys = {{from_s, {-8.0, 0.0}}, {to_s, {8.0, 0.0}}}, .radius_m = 1.0, .life_s = 0.05};
  return std::make_shared<const Inputs>(InputTarget::dynamic_waves, std::span(&spec, 1));
}
DynamicSeaSettings dry_sea() {
  DynamicSeaSettings s;
  s.waves = small_waves();
  s.settle_s = 0.5;
  return s;
}
const glm::dvec3 head{0.0, 2.0, 0.0};

// A trail that presses leaves a wake behind it and nothing ahead, whatever the frame rate, to the bit; before it comes
// nothing is done. Control seen: the pressure of the frame's time instead of its step's.
TEST(Pressure, ATrailLeavesAWakeAtEveryFrameRateAlike) {
  DynamicSea reference(dry_sea(), boat(11.0, 15.0));
  EXPECT_FALSE(reference.update(10.0, head));
  EXPECT_FALSE(reference.update(10.5, head));
  EXPECT_FALSE(reference.waves().active());
  for (int i = 1; i <= 180; ++i) reference.update(10.5 + i / 60.0, head);
  double behind = 0.0, ahead = 0.0;
  for (double z = -3.0; z <= 3.0; z += 0.3) {
    for (double x = -4.0; x < 1.0; x += 0.3) behind = std::max(behind, std::abs(height(reference.surface(), {x, z})));
    for (double x = 6.0; x < 7.0; x += 0.3) ahead = std::max(ahead, std::abs(height(reference.surface(), {x, z})));
  }
  EXPECT_GT(behind, 0.005);
  EXPECT_LT(ahead, 0.2 * behind) << "the boat is at 2 m";
  for (const double rate : {30.0, 72.0, 120.0}) {
    DynamicSea sea(dry_sea(), boat(11.0, 15.0));
    sea.update(10.0, head);
    for (int i = 0; i <= int(3.0 * rate); ++i) sea.update(10.5 + i / rate, head);
    for (double x = -7.0; x < 7.0; x += 0.7)
      EXPECT_EQ(height(sea.surface(), {x, 1.1}), height(reference.surface(), {x, 1.1})) << rate;
  }
}

TEST(Pressure, MakesASeaThatIsNotStill) {
  EXPECT_TRUE(still(dry_sea()));
  EXPECT_FALSE(still(dry_sea(), true));
  DynamicSeaSettings land = dry_sea();
  land.waves.depth_m = 0.0;
  EXPECT_TRUE(still(land, true));
}

}  // namespace
}  // namespace seascape
