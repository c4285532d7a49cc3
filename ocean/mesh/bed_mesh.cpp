#include "ocean/mesh/bed_mesh.h"

#include <algorithm>
#include <cmath>

#include "ocean/mesh/tree_frame.h"

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
  // The texels of the bed's windows are about a sixty-fourth of their distance wide (PlaceSettings).
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
  const double over_m = viewpoint.viewer.position_m.y - middle_m;
  within.gone = [&, over_m](glm::dvec2 least, glm::dvec2 most) {
    if (glm::length(viewer - glm::clamp(viewer, least, most)) > bed.sight_m) return true;
    if (bed.portals == nullptr) return false;
    const glm::dvec2 middle = 0.5 * (least + most) - viewer;
    const glm::dvec3 half(0.5 * (most.x - least.x), bounds.vertical_m, 0.5 * (most.y - least.y));
    const double drop_m = curvature_drop(bed.sight_m * bed.sight_m);
    return !bed.portals->may_show({middle.x, -over_m, middle.y}, glm::length(half) + drop_m);
  };
  return tree_.select(over_middle_, within);
}

}  // namespace seascape
