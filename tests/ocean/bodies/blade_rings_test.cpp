// What a blade sweeps, before it and behind, and the rings that it leaves.
#include "ocean/bodies/blade_rings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/ocean/places/waves_support.h"

namespace seascape {
namespace {

Blade stroke(double slip_mps, double depth_m = 0.15) {
  Blade blade;
  blade.at_m = {2.0, -depth_m, 1.0};
  blade.normal = {0.0, 0.0, 1.0};
  blade.slip_mps = blade.velocity_mps = {0.0, 0.0, slip_mps};
  return blade;
}

std::vector<WaveSource> sources_of(const Blade& blade) {
  std::vector<WaveSource> sources;
  add_blade_sources(blade, 0.0, 0.25, sources);
  return sources;
}

double flow(const WaveSource& s) { return s.rise_mps * s.length_m * s.length_m / std::numbers::pi; }

// As much before as is drawn in behind, by the area and the slip across the face, whichever way the face looks; none
// edgeways, at rest and in the air. Controls: a face that looks one way; two sources and no sink; both seen.
TEST(BladeRings, PushesAndDrawsIn) {
  for (const double slip : {1.5, -1.5})
    for (const double face : {1.0, -1.0}) {
      Blade blade = stroke(slip);
      blade.normal *= face;
      const std::vector<WaveSource> sources = sources_of(blade);
      ASSERT_EQ(sources.size(), 2u);
      EXPECT_NEAR(flow(sources[0]), 0.15, 1e-12);
      EXPECT_NEAR(flow(sources[0]) + flow(sources[1]), 0.0, 1e-15);
      EXPECT_NEAR(sources[0].place_m.y - 1.0, slip > 0.0 ? 0.1 : -0.1, 1e-12) << "before it";
      EXPECT_NEAR(sources[0].depth_m, 0.15, 1e-12);
    }
  Blade edgeways = stroke(1.5);
  edgeways.normal = {1.0, 0.0, 0.0};
  EXPECT_TRUE(sources_of(edgeways).empty());
  EXPECT_TRUE(sources_of(stroke(0.0)).empty());
  EXPECT_TRUE(sources_of(stroke(1.5, -0.2)).empty());
  EXPECT_NEAR(flow(sources_of(stroke(1.5, 0.0))[0]), 0.075, 1e-12) << "half in the water";
}

// Strokes leave rings that a harder and a shallower one makes higher. Control: blades at the surface; seen.
TEST(BladeRings, LeavesRings) {
  const auto rings_m = [](double slip, double depth) {
    const DynamicWavesSettings s = waves_test::quiet(128, 2, 1.0 / 32.0);
    DynamicWaves waves(s);
    const LodPlacement placement = lod_placement(s.windows, {2.0, 1.0}, {});
    for (int i = 0; i < 30; ++i) waves.advance(1.0 / 60.0, placement, sources_of(stroke(slip, depth)));
    const waves_test::Surface surface(waves);
    double highest = 0.0;
    for (int i = 0; i < 24; ++i)
      highest = std::max(highest, std::abs(surface.at(glm::dvec2(2.0, 1.0) +
                                                      0.5 * glm::dvec2(std::cos(i * 0.2618), std::sin(i * 0.2618)))));
    return highest;
  };
  const double usual = rings_m(1.0, 0.15);
  EXPECT_GT(usual, 1e-3);
  EXPECT_LT(usual, 0.2);
  EXPECT_GT(rings_m(2.0, 0.15), 1.8 * usual);
  EXPECT_LT(rings_m(1.0, 0.6), 0.4 * usual);
}

}  // namespace
}  // namespace seascape
