// Morphed joins: the mesh that patches of all levels and the skirt make together is closed to the bit, folds nowhere,
// stays in its patches, and does not change at once when a level does.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/ocean/mesh/lod_support.h"
#include "tests/support/sampled.h"
#include "tests/support/sanitized.h"

namespace seascape {
namespace {
using namespace lod_test;

glm::dvec3 anywhere(std::mt19937& random, const Quadtree& tree, int n) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double height = std::pow(10.0, 1.8 + 2.5 * unit(random)) * (n % 7 == 3 ? -0.05 : 1.0);
  const double node = tree.settings().ocean_size_m / (1 << (n % 12));
  if (n % 5 == 1) return {node, 1.7, -3.0 * node};  // on a corner of the tree
  return {unit(random) * 3000.0, n % 5 == 2 ? 1.7 : height, unit(random) * 3000.0};
}

// Every edge of the mesh, vertices identified by the bits of their places, belongs to two triangles that run along it
// in opposite directions, or to the skirt's outer border; no triangle is turned over and together they cover the root
// once. Calm and storm, and an error larger than any preset's. Controls seen, each fails here: vertices that arrive 10
// % beyond the reach, distance by the vertex itself instead of the one it slides to, the skirt's strips not sliding, a
// twelfth of the room between levels beyond the visible reach.
void expect_watertight(LodLaw law, LodJoin join, int poses) {
  std::mt19937 random(3);
  for (std::size_t k = 0; k < 5; ++k)
    for (const double size : {256.0, 777.7, 1024.0, 4096.0, 8192.0}) {
      LodSettings settings = settings_of(presets[std::min<std::size_t>(k, 3)], size, join);
      settings.by = law;
      if (k == 4) settings.pixel_error = 64.0, settings.threshold = 4.0, settings.patch_quads = 16;
      Quadtree tree(settings);
      for (int n = 0; n < poses; ++n) {
        const glm::dvec3 eye = anywhere(random, tree, n);
        const double vertical = std::array{0.0, 0.05, 0.8, 3.0, 12.0}[static_cast<std::size_t>(n) % 5];
        const SurfaceSelection& s = tree.select(everything_from(eye), {vertical, vertical});
        const Topology t = topology_of(s);
        const double area = 8.0 * s.half_size * static_cast<double>(s.half_size);
        const std::string what = std::string(k == 4 ? "coarsest" : presets[k].name) + ' ' + std::to_string(size) +
                                 " from " + std::to_string(eye.x) + ' ' + std::to_string(eye.y) + ' ' +
                                 std::to_string(eye.z) + ", waves of " + std::to_string(vertical);
        ASSERT_EQ(t.open_edges, 0) << what;
        ASSERT_EQ(t.crowded_edges, 0) << what;
        ASSERT_EQ(t.folded, 0) << what;
        ASSERT_NEAR(t.twice_area, area, 1e-9 * area) << what;
      }
    }
}

TEST(MorphHard, TheWholeMeshIsWatertight) {
  expect_watertight(LodLaw::pixel_error, LodJoin::morphed, test::sanitized ? 6 : 24);
}

// Both laws, stitched and morphed: 500 poses each with SEASCAPE_LONG=1. Control seen: coarser_sides() of masked joins
// returning 0.
TEST(MorphHard, TheWholeMeshIsWatertightByBothLawsAndJoins) {
  const int poses = test::long_run() ? 20 : 2;
  for (const LodLaw law : {LodLaw::pixel_error, LodLaw::threshold})
    for (const LodJoin join : {LodJoin::masked, LodJoin::morphed}) {
      SCOPED_TRACE(std::string(law == LodLaw::threshold ? "threshold" : "pixel_error") +
                   (join == LodJoin::masked ? ", masked" : ", morphed"));
      expect_watertight(law, join, poses);
    }
}

// Control seen: spacing_over_distance without the threshold.
TEST(MorphHard, ALowerThresholdMakesMoreTriangles) {
  for (const Preset& preset : presets)
    for (const LodJoin join : {LodJoin::masked, LodJoin::morphed}) {
      LodSettings settings = by_threshold(settings_of(preset, 4096.0, join));
      std::size_t fewer = 0;
      for (const double threshold : {4.0, 2.0, 1.0, 0.5}) {
        settings.threshold = threshold;
        const std::size_t patches =
            Quadtree(settings).select(everything_from({12.0, 3.0, -7.0}), {1.5, 1.5}).patches.size();
        EXPECT_GT(patches, fewer + fewer / 2) << preset.name << ' ' << threshold;
        fewer = patches;
      }
    }
}

TEST(MorphHard, ADroppedPatchOrStripOpensTheMesh) {
  LodSettings settings = settings_of(presets[0], 1024.0, LodJoin::morphed);
  const Viewpoint view = everything_from({3.0, 1.7, 5.0});
  const int patches = static_cast<int>(Quadtree(settings).select(view, {}).patches.size());
  for (int drop = 0; drop < patches; drop += 3) {
    settings.drop_patch = drop;
    EXPECT_GE(topology_of(Quadtree(settings).select(view, {})).open_edges, 4) << drop;
  }
}

// Culling takes a patch for its square: no vertex slides out of it. And vertices do slide. Control seen: with the ratio
// not bounded.
TEST(MorphHard, VerticesStayInTheirPatch) {
  std::mt19937 random(4);
  int slid = 0, arrived = 0;
  for (const Preset& preset : presets)
    for (const double pixels : {0.0, 64.0}) {
      LodSettings settings = settings_of(preset, 4096.0, LodJoin::morphed);
      if (pixels > 0.0) settings.pixel_error = pixels;
      Quadtree tree(settings);
      for (int n = 0; n < 40; ++n) {
        const SurfaceSelection& s = tree.select(everything_from(anywhere(random, tree, n)), {n % 3 * 1.5 + 0.1, 1.0});
        for (const auto& p : s.patches) {
          if (is_skirt(p)) continue;
          const glm::vec2 low(p.corner), high(p.corner + p.stride * gpu::patch_quads);
          for (int j = 0; j <= gpu::patch_quads; ++j)
            for (int i = 0; i <= gpu::patch_quads; ++i) {
              const glm::vec2 at =
                  gpu::morphed(s.mesh.morph, gpu::patch_coordinate(p, i, j), s.mesh.tree_centre, p.stride);
              ASSERT_TRUE(glm::all(glm::greaterThanEqual(at, low)) && glm::all(glm::lessThanEqual(at, high)))
                  << preset.name << ", stride " << p.stride << ", " << at.x - low.x << ' ' << at.y - low.y;
              const glm::vec2 by = glm::vec2(gpu::patch_coordinate(p, i, j)) - at;
              const float most = std::max(by.x, by.y) / static_cast<float>(p.stride);
              slid += most > 0.0f && most < 1.0f ? 1 : 0;
              arrived += most >= 1.0f ? 1 : 0;
            }
        }
      }
    }
  EXPECT_GT(slid, 10000);
  EXPECT_GT(arrived, 10000);
}

// Height of the mesh over a swell at a place, in metres; vertices stand on the swell.
double mesh_height(const SurfaceSelection& s, const glm::dvec2& place_m, double wavelength_m) {
  static const std::vector<std::uint16_t> indices = patch_indices(gpu::patch_quads);
  const glm::dvec2 at = (place_m - s.grid_origin_m) / s.unit_m;
  for (const auto& p : s.patches) {
    const glm::dvec2 low(p.corner), high(p.corner + p.stride * gpu::patch_quads);
    if (is_skirt(p) || !glm::all(glm::lessThanEqual(low, at)) || !glm::all(glm::lessThan(at, high))) continue;
    for (std::size_t t = 0; t < indices.size(); t += 3) {
      std::array<glm::dvec2, 3> v;
      for (std::size_t c = 0; c < 3; ++c)
        v[c] = glm::dvec2(
            key_of(s, p, indices[t + c] % (gpu::patch_quads + 1), indices[t + c] / (gpu::patch_quads + 1)).place);
      const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
      const double whole = cross(v[1] - v[0], v[2] - v[0]);
      if (std::abs(whole) < 1e-9) continue;
      const double a = cross(v[1] - at, v[2] - at) / whole, b = cross(v[2] - at, v[0] - at) / whole, c = 1.0 - a - b;
      if (std::min({a, b, c}) < -1e-9) continue;
      const auto height = [&](const glm::dvec2& vertex) {
        const glm::dvec2 world = s.grid_origin_m + vertex * s.unit_m;
        return 0.05 * wavelength_m * std::sin(world.x * 6.2832 / wavelength_m) *
               std::cos(world.y * 6.2832 / wavelength_m);
      };
      return a * height(v[0]) + b * height(v[1]) + c * height(v[2]);
    }
  }
  return std::nan("");
}

// The greatest step of the mesh's height at places about a viewer who glides by 2 cm at a time, over a frozen swell.
// Masked joins are the control: there a level changes at once, by up to what the coarser mesh misses.
double greatest_step(LodJoin join, const Preset& preset) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Quadtree tree(settings_of(preset, 1024.0, join));
  std::vector<std::pair<glm::dvec2, double>> places;
  // Each with a swell that a mesh at that distance just resolves, where missing it shows most.
  for (int n = 0; n < 40; ++n) {
    const glm::dvec2 off = glm::dvec2{unit(random), unit(random)} * std::pow(10.0, 1.2 + 0.8 * unit(random));
    places.push_back({off, std::max(8.0 * spacing_over_distance(tree.settings()) * glm::length(off), 2.0)});
  }
  std::vector<double> before(places.size(), std::nan(""));
  double most = 0.0;
  for (int step = 0; step < 300; ++step) {
    const glm::dvec3 eye(0.02 * step, 1.7 + 0.003 * step, -0.013 * step);
    const SurfaceSelection& s = tree.select(everything_from(eye), {3.0, 0.0});
    for (std::size_t n = 0; n < places.size(); ++n) {
      const double height = mesh_height(s, places[n].first, places[n].second);
      EXPECT_FALSE(std::isnan(height));
      if (step > 0) most = std::max(most, std::abs(height - before[n]) / places[n].second);
      before[n] = height;
    }
  }
  return most;
}

TEST(MorphHard, NothingPopsWhileTheViewerGlides) {
  for (const Preset& preset : presets) {
    const double morphed = greatest_step(LodJoin::morphed, preset), masked = greatest_step(LodJoin::masked, preset);
    RecordProperty(preset.name, std::to_string(morphed) + " and masked " + std::to_string(masked) + " of a wavelength");
    EXPECT_LT(morphed, 2.5e-3) << preset.name;
    EXPECT_GT(masked, 3.0 * morphed) << preset.name;
  }
}

}  // namespace
}  // namespace seascape
