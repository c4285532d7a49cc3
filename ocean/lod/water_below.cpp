#include "ocean/lod/water_below.h"

#include <algorithm>
#include <array>
#include <bit>
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

template <class Value>
void WaterCulling::Known<Value>::begin(std::size_t count) {
  const std::size_t size = std::bit_ceil(2 * count);
  if (slots.size() < size) slots.assign(size, {});
  held = 0;
}

// Beyond three quarters full nothing is added, so that a search always ends.
template <class Value>
template <class Make>
Value WaterCulling::Known<Value>::find(std::uint64_t key, std::uint32_t call, const Make& make) {
  const std::size_t mask = slots.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 32) & mask;
  for (; slots[at].call == call; at = (at + 1) & mask)
    if (slots[at].key == key) return slots[at].value;
  const Value value = make();
  if (4 * held < 3 * slots.size()) {
    slots[at] = {key, call, value};
    ++held;
  }
  return value;
}

void WaterCulling::operator()(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta, const glm::dvec3& viewer_m,
                              SurfaceSelection& selection, double scale) {
  constexpr double most_m = 4.0;
  constexpr int node_patches = 4;  // along a side
  const MeshError& error = field.statistics().mesh_error;
  const glm::dvec2 viewer = glm::dvec2(viewer_m.x, viewer_m.z) - selection.grid_origin_m;
  const WaveField::Filter filter = field.filter(0.0);  // what the patches' own vertices leave out of the waves is less than what a mesh of their size misses
  const glm::ivec2 least = selection.tree_centre - selection.half_size;
  corners_.begin(selection.patches.size());
  nodes_.begin(selection.patches.size());
  if (++call_ == 0) {  // what is left of calls so long ago is nothing known
    corners_.slots.assign(corners_.slots.size(), {});
    nodes_.slots.assign(nodes_.slots.size(), {});
    call_ = 1;
  }
  // Of a corner's place from the tree's least corner, and of a node also its level.
  const auto key = [](glm::ivec2 place, int level) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(place.x)) << 32 | static_cast<std::uint64_t>(static_cast<std::uint32_t>(place.y)) << 5 | static_cast<std::uint64_t>(level);
  };
  double off_m = 0.0;
  int stride = 0, level = 0;
  const auto seen = [&](glm::ivec2 place) {
    UprightPrism prism{{}, off_m, 1e30, -1e30};
    double farthest2 = 0.0;
    for (std::size_t c = 0; c < 4; ++c) {
      const glm::ivec2 corner = place + glm::ivec2(c & 1u, c >> 1) * (node_patches * stride * gpu::patch_quads);
      const glm::dvec2 rest = glm::dvec2(least + corner) * selection.unit_m;
      const glm::dvec3 d = corners_.find(key(corner, 0), call_, [&] { return glm::vec3(field.displacement(tiles, selection.grid_origin_m + rest, filter)); });
      prism.corners[c] = rest + glm::dvec2(d.x, d.z);
      prism.low = std::min(prism.low, d.y);
      prism.high = std::max(prism.high, d.y);
      const glm::dvec2 away = prism.corners[c] - viewer;
      farthest2 = std::max(farthest2, glm::dot(away, away));
    }
    prism.low -= off_m + curvature_drop(farthest2);
    prism.high += off_m;
    EyeFrusta::Questions questions = frusta.all();
    return frusta.may_see(prism, questions);
  };
  const auto unseen = [&](const gpu::PatchInstance& patch) {
    const double size_m = patch.stride * gpu::patch_quads * selection.unit_m;
    if (size_m > most_m || (patch.flags & gpu::patch_skirt) != 0u) return false;
    if (patch.stride != stride) {
      stride = patch.stride;
      level = static_cast<int>(gpu::patch_level(patch.flags));
      off_m = scale * error(node_patches * size_m) + 0.01;
    }
    const glm::ivec2 node = (patch.corner - least) & -(node_patches * stride * gpu::patch_quads);
    return !nodes_.find(key(node, level), call_, [&] { return seen(node); });
  };
  const auto end = std::remove_if(selection.patches.begin(), selection.patches.end(), unseen);
  selection.culled_nodes += static_cast<int>(selection.patches.end() - end);
  selection.patches.erase(end, selection.patches.end());
}

}  // namespace seascape
