#include "ocean/lod/water_below.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ocean/lod/culling.h"
#include "ocean/lod/tree_frame.h"

namespace seascape {

std::optional<DisplacementBounds::Below> water_below(const WaveField& field, const WaveTiles& tiles, const glm::dvec3& viewer_m,
                                                     const NearMotion& motion) {
  if (!std::isfinite(viewer_m.x + viewer_m.y + viewer_m.z)) return std::nullopt;
  constexpr int steps = 8;  // each multiplies what is left by the waves' steepness, some 0.2
  const WaveField::Filter filter = field.filter(NearMotion::footprint_m);
  const glm::dvec2 at(viewer_m.x, viewer_m.z);
  DisplacementBounds::Below result{at, glm::dvec3(0.0), motion};
  for (int n = 0; n < steps; ++n) {
    result.displacement_m = field.displacement(tiles, result.rest_m, filter);
    result.rest_m = at - glm::dvec2(result.displacement_m.x, result.displacement_m.z);
  }
  return result;
}

void cull_by_water(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta, double cull_scale, const glm::dvec3& viewer_m,
                   SurfaceSelection& selection) {
  constexpr double most_m = 4.0;
  const MeshError& error = field.statistics().mesh_error;
  const glm::dvec2 viewer = glm::dvec2(viewer_m.x, viewer_m.z) - selection.grid_origin_m;
  WaveField::Filter filter;
  double off_m = 0.0;
  int stride = 0;
  const auto unseen = [&](const gpu::PatchInstance& patch) {
    const double size_m = patch.stride * gpu::patch_quads * selection.unit_m;
    if (size_m > most_m || (patch.flags & gpu::patch_skirt) != 0u) return false;
    if (patch.stride != stride) {
      stride = patch.stride;
      // What the patch's own vertices leave out of the waves is less than what a mesh of its size does.
      filter = field.filter(0.0);
      off_m = cull_scale * error(size_m) + 0.01;
    }
    UprightPrism prism{{}, off_m, 1e30, -1e30};
    double farthest2 = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
      const glm::dvec2 rest = glm::dvec2(patch.corner + glm::ivec2(c & 1u, c >> 1) * (patch.stride * gpu::patch_quads)) * selection.unit_m;
      const glm::dvec3 d = field.displacement(tiles, selection.grid_origin_m + rest, filter);
      prism.corners[c] = rest + glm::dvec2(d.x, d.z);
      prism.low = std::min(prism.low, d.y);
      prism.high = std::max(prism.high, d.y);
      const glm::dvec2 away = prism.corners[c] - viewer;
      farthest2 = std::max(farthest2, glm::dot(away, away));
    }
    prism.low -= off_m + curvature_drop(farthest2);
    prism.high += off_m;
    EyeFrusta::Questions questions = frusta.all();
    return !frusta.may_see(prism, questions);
  };
  const auto end = std::remove_if(selection.patches.begin(), selection.patches.end(), unseen);
  selection.culled_nodes += static_cast<int>(selection.patches.end() - end);
  selection.patches.erase(end, selection.patches.end());
}

}  // namespace seascape
