// The tree's triangles beside those of concentric rings and of a uniform grid that miss the sea by as little: fewer
// than either.
#include <gtest/gtest.h>

#include <string>

#include "app/lab/screen_error.h"
#include "app/scene.h"
#include "tests/ocean/mesh/lod_support.h"

namespace seascape {
namespace {
using namespace lod_test;

// Culls boxes of a rival as the tree culls its own: the same frusta, the same bounds of the water's motion by distance.
class Sight {
 public:
  Sight(const Viewpoint& view, const DisplacementBounds& bounds, double cull_scale, const glm::dvec2& origin)
      : bounds_(bounds),
        scale_(cull_scale),
        centre_(bounds.below->rest_m - origin),
        viewer_(glm::dvec2(view.viewer.position_m.x, view.viewer.position_m.z) - origin) {
    frusta_.set(view.eyes, {origin.x, 0.0, origin.y});
  }
  glm::dvec2 centre() const { return centre_; }
  bool sees(const glm::dvec2& low, const glm::dvec2& high) const {
    const double around = glm::length(glm::max(glm::abs(low - centre_), glm::abs(high - centre_)));
    const glm::dvec2 off = 5.8 * bounds_.below->motion(around) + 0.01;
    const glm::dvec3 d = bounds_.below->displacement_m, about(off.y, off.x, off.y);
    const glm::dvec3 most(scale_ * bounds_.horizontal_m, scale_ * bounds_.vertical_m, scale_ * bounds_.horizontal_m);
    const glm::dvec3 least_by = glm::max(-most, d - about), most_by = glm::min(most, d + about);
    const glm::dvec2 a = low + glm::dvec2(least_by.x, least_by.z), b = high + glm::dvec2(most_by.x, most_by.z);
    const glm::dvec2 far = glm::max(glm::abs(a - viewer_), glm::abs(b - viewer_));
    const glm::dvec2 middle = 0.5 * (a + b), half = 0.5 * glm::abs(b - a);
    const UprightBox box{middle.x, middle.y, half.x, half.y, least_by.y - curvature_drop(glm::dot(far, far)),
                         most_by.y};
    return frusta_.may_see(box);
  }

 private:
  const DisplacementBounds& bounds_;
  double scale_;
  glm::dvec2 centre_, viewer_;
  EyeFrusta frusta_;
};

constexpr double vertices_a_triangle =
    (gpu::patch_quads + 1.0) * (gpu::patch_quads + 1.0) / (2.0 * gpu::patch_quads * gpu::patch_quads);

struct Triangles {
  double tree = 0.0, rings = 0.0, grid = 0.0;
};

// Rings: square, each twice as wide as the one inside and with twice its spacing; twelve blocks a ring, four by four
// without the inner two by two, culled one by one. As wide as the tree's law demands: a spacing may double where the
// tree's may, beyond reach(n), measured straight down too. A ring's vertices keep to the lattice of the next ring's, so
// that it may lie two spacings off the viewer, and a block has an even number of quads, so that its vertices can slide
// onto the next ring's. Rings nearer than the water is high beneath the eye are left out, the innermost is filled.
// Grid: everywhere the spacing that the nearest water needs, culled by squares of a sixty-fourth of the ocean.
// The tree without its skirt and without the culling by the water that stands there, which rivals could have as well.
Triangles of_one_view(const SurfaceSelection& s, const Sight& sight, int levels, double ocean_m) {
  Triangles result;
  for (const auto& p : s.patches) result.tree += is_skirt(p) ? 0.0 : 2.0 * gpu::patch_quads * gpu::patch_quads;
  const double gap = static_cast<double>(s.mesh.morph.height) * s.unit_m;
  const auto reach = [&](int n) { return static_cast<double>(gpu::morph_reach(s.mesh.morph, n)) * s.unit_m; };
  double scale = 0.0;  // half a ring's outer side over its spacing, the same for all rings
  int first = -1;
  for (int n = 0; n < levels; ++n)
    if (reach(n) > gap) {
      if (first < 0) first = n;
      scale = std::max(scale, std::sqrt(reach(n) * reach(n) - gap * gap) / std::ldexp(s.unit_m, n));
    }
  if (first < 0) first = levels;
  const double quads = 4.0 * std::ceil(0.25 * (scale + 2.0));
  for (int n = first;; ++n) {
    const double spacing = std::ldexp(s.unit_m, n), half = quads * spacing, block = 0.5 * half;
    for (int x = 0; x < 4; ++x)
      for (int z = 0; z < 4; ++z) {
        if (n > first && x > 0 && x < 3 && z > 0 && z < 3) continue;
        const glm::dvec2 low = sight.centre() + glm::dvec2(x - 2, z - 2) * block;
        if (sight.sees(low, low + block)) result.rings += 2.0 * block * block / (spacing * spacing);
      }
    if (half >= 0.5 * ocean_m || scale == 0.0) break;
  }
  const double finest = std::ldexp(s.unit_m, first), square = ocean_m / 64.0;
  for (int x = 0; x < 64; ++x)
    for (int z = 0; z < 64; ++z) {
      const glm::dvec2 low = sight.centre() + glm::dvec2(x - 32, z - 32) * square;
      if (sight.sees(low, low + square)) result.grid += 2.0 * square * square / (finest * finest);
    }
  return result;
}

// Prints the table of docs/performance.md. Control seen: nodes that split half as far again as their reach (rings
// then have fewer).
TEST(MeshRivalsHard, TheTreeHasFewerTrianglesThanRingsAndAGrid) {
  std::printf("| preset, scene | tree: vertices, triangles | rings | grid |\n");
  for (const Preset& preset : presets)
    for (const char* scene : {"open_sea", "storm", "calm", "swell"}) {
      const Settings settings = load_scene(scene, preset.name).settings;
      const WaveField field(settings.sea, settings.waves);
      WaveTiles tiles;
      field.evaluate(ticks_from_seconds(17.0), tiles);
      Quadtree tree(settings.lod);
      std::mt19937 random(8);
      Triangles sum;
      constexpr int poses = 40;
      for (int n = 0; n < poses; ++n) {
        const Viewpoint view = pose_over(field, tiles, random, n);
        const DisplacementBounds bounds = bounds_of(field, tiles, view.viewer.position_m);
        const SurfaceSelection& s = tree.select(view, bounds);
        const Triangles t = of_one_view(s, Sight(view, bounds, settings.lod.cull_scale, s.grid_origin_m), tree.levels(),
                                        settings.lod.ocean_size_m);
        sum.tree += t.tree / poses, sum.rings += t.rings / poses, sum.grid += t.grid / poses;
      }
      std::printf("| %s %s | %.0f, %.0f | %.0f (%.2f) | %.3g (%.3g) |\n", preset.name, scene,
                  sum.tree * vertices_a_triangle, sum.tree, sum.rings, sum.rings / sum.tree, sum.grid,
                  sum.grid / sum.tree);
      EXPECT_LT(sum.tree, sum.rings) << preset.name << ' ' << scene;
      EXPECT_LT(sum.tree, sum.grid) << preset.name << ' ' << scene;
    }
}

}  // namespace
}  // namespace seascape
