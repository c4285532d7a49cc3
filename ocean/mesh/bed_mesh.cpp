#include "ocean/mesh/bed_mesh.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {
// Vertices are a quarter of a metre apart at least: a texel of the finest window (PlaceSettings).
LodSettings settings_for(double spacing_over_distance, bool earth_curvature) {
  LodSettings lod;
  lod.ocean_size_m = 1024.0;
  lod.patch_quads = 16;
  lod.levels = 8;
  lod.threshold = std::clamp(spacing_over_distance * lod.patch_quads / Quadtree::split_ratio, 0.5, 4.0);
  lod.skirt_multiplier = 1.0;
  lod.cull_scale = 1.0;
  lod.earth_curvature = earth_curvature;
  return lod;
}
}  // namespace

BedMesh::BedMesh() : tree_(settings_for(spacing_over_distance(0.0), true)) {}

double BedMesh::spacing_over_distance(double pixels_per_radian) {
  constexpr double pixels = 10.0, least = 1.0 / 64.0;
  return std::max(least, pixels / (pixels_per_radian > 0.0 ? pixels_per_radian : reference_pixels_per_radian));
}

const SurfaceSelection& BedMesh::select(const Viewpoint& viewpoint, const BedInSight& bed) {
  tree_.apply(settings_for(spacing_over_distance(viewpoint.pixels_per_radian), bed.earth_curvature));
  const double middle_m = 0.5 * (bed.highest_m + bed.lowest_m);
  over_middle_ = viewpoint;
  over_middle_.viewer.position_m.y -= middle_m;
  for (View& eye : over_middle_.eyes) eye.pose.position_m.y -= middle_m;
  DisplacementBounds bounds;
  bounds.vertical_m = std::max(0.5 * (bed.highest_m - bed.lowest_m), 0.1);
  bounds.horizontal_m = 0.0;
  MeshWater within(bounds);
  const glm::dvec2 viewer(viewpoint.viewer.position_m.x, viewpoint.viewer.position_m.z);
  within.gone = [&bed, &viewer](glm::dvec2 least, glm::dvec2 most) {
    return glm::length(viewer - glm::clamp(viewer, least, most)) > bed.sight_m;
  };
  return tree_.select(over_middle_, within);
}

}  // namespace seascape
