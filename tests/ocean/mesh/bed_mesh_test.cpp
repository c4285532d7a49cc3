#include "ocean/mesh/bed_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shaders/shared/patch_vertex.h"

namespace seascape {
namespace {

Viewpoint diver(glm::dvec3 place, double pitch_deg) {
  Viewpoint viewpoint;
  viewpoint.viewer = {place, glm::angleAxis(glm::radians(pitch_deg), glm::dvec3(1.0, 0.0, 0.0))};
  viewpoint.eyes = stereo_views(viewpoint.viewer, symmetric_fov(80.0, 1.0), 0.063);
  viewpoint.pixels_per_radian = 1000.0;
  return viewpoint;
}

// Whether a patch holds a place of the world.
bool holds(const SurfaceSelection& s, const gpu::PatchInstance& patch, glm::dvec2 place_m) {
  const glm::dvec2 at = (place_m - s.grid_origin_m) / s.unit_m - glm::dvec2(patch.corner);
  const double side = gpu::patch_quads * patch.stride;
  return at.x >= 0.0 && at.y >= 0.0 && at.x < side && at.y < side;
}

// Every place of the bed that an eye sees within sight lies in one patch, however it looks; and none is drawn beyond.
// Controls seen: heights not taken from the bed's middle; sight halved.
TEST(BedMesh, CoversWhatADiverSees) {
  BedMesh mesh;
  const BedInSight bed{-9.0, -5.0, 60.0, false};
  for (const double pitch_deg : {-90.0, -50.0, -20.0, 0.0, 45.0}) {
    const Viewpoint viewpoint = diver({13.7, -3.0, -210.2}, pitch_deg);
    const SurfaceSelection& s = mesh.select(viewpoint, bed);
    const auto patches = BedMesh::patches(s);
    int seen = 0;
    for (double across = -0.8; across < 0.81; across += 0.1)
      for (double up = -0.8; up < 0.81; up += 0.1) {
        const glm::dvec3 ray = viewpoint.viewer.orientation * glm::dvec3(across, up, -1.0),
                         eye = viewpoint.viewer.position_m;
        for (const double depth_m : {bed.lowest_m, bed.highest_m}) {
          const double t = (depth_m - eye.y) / ray.y;
          const glm::dvec2 place = glm::dvec2(eye.x, eye.z) + t * glm::dvec2(ray.x, ray.z);
          if (!(t > 0.0) || glm::length(place - glm::dvec2(eye.x, eye.z)) > bed.sight_m) continue;
          ++seen;
          EXPECT_EQ(std::count_if(patches.begin(), patches.end(), [&](const auto& p) { return holds(s, p, place); }), 1)
              << pitch_deg << ": " << place.x << ", " << place.y;
        }
      }
    EXPECT_EQ(seen > 0, pitch_deg < 44.0) << pitch_deg;
    for (const gpu::PatchInstance& patch : patches) {
      const glm::dvec2 least = s.grid_origin_m + s.unit_m * glm::dvec2(patch.corner), eye(13.7, -210.2);
      EXPECT_LT(glm::length(glm::clamp(eye, least, least + s.unit_m * gpu::patch_quads * patch.stride) - eye),
                bed.sight_m + 0.02);
    }
  }
}

// Vertices are as far apart as spacing_over_distance() says at most, and not all as near as they may be.
// Control seen: spacings of another threshold.
TEST(BedMesh, IsAsFineAsItsPixels) {
  BedMesh mesh;
  const Viewpoint viewpoint = diver({0.0, -3.0, 0.0}, -30.0);
  const SurfaceSelection& s = mesh.select(viewpoint, {-8.0, -6.0, 80.0, false});
  const double ratio = BedMesh::spacing_over_distance(viewpoint.pixels_per_radian);
  ASSERT_FALSE(BedMesh::patches(s).empty());
  int coarse = 0;
  for (const gpu::PatchInstance& patch : BedMesh::patches(s)) {
    const glm::dvec2 least = s.grid_origin_m + s.unit_m * glm::dvec2(patch.corner),
                     most = least + s.unit_m * gpu::patch_quads * patch.stride;
    const double away_m = glm::length(glm::dvec3(glm::max(glm::max(least, -most), glm::dvec2(0.0)), 3.0)),
                 spacing_m = s.unit_m * patch.stride;
    EXPECT_LE(spacing_m, std::max(s.unit_m, 1.01 * ratio * away_m)) << away_m;
    coarse += spacing_m > 0.4 * ratio * away_m;
  }
  EXPECT_GT(coarse, int(BedMesh::patches(s).size()) / 3);
}

}  // namespace
}  // namespace seascape
