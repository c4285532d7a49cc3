#include "ocean/lod/water_below.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ocean/lod/culling.h"
#include "ocean/lod/tree_frame.h"
#include "ocean/waves/query.h"

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

void WaterCulling::Known::begin(std::size_t count) {
  const std::size_t size = std::bit_ceil(count);
  if (slots.size() < size) slots.assign(size, {});
  mask = size - 1;
  room = size - size / 4;
}

std::uint32_t& WaterCulling::Known::find(glm::ivec2 place, int level, std::uint32_t call) {
  const std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(place.x)) << 32 |
                            static_cast<std::uint64_t>(static_cast<std::uint32_t>(place.y)) << 5 | static_cast<std::uint64_t>(level);
  std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 40) & mask;
  for (; slots[at].call == call; at = (at + 1) & mask)
    if (slots[at].key == key) return slots[at].index;
  if (room == 0) return none = unknown;
  --room;
  slots[at] = {key, call, unknown};
  return slots[at].index;
}

// First the nodes of all patches, and the places of their corners, each once; then the water at all of these, so many at a time as vectors are wide;
// then which nodes are seen; then the patches.
void WaterCulling::operator()(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta, const glm::dvec3& viewer_m,
                              SurfaceSelection& selection, double scale) {
  constexpr double most_m = 4.0;
  constexpr int node_patches = 4;  // along a side
  const MeshError& error = field.statistics().mesh_error;
  const glm::dvec2 viewer = glm::dvec2(viewer_m.x, viewer_m.z) - selection.grid_origin_m;
  const glm::ivec2 least = selection.tree_centre - selection.half_size;
  std::vector<gpu::PatchInstance>& patches = selection.patches;
  known_nodes_.begin(patches.size() + 8);
  known_corners_.begin(patches.size() + 8);
  if (++call_ == 0) {  // what is left of calls so long ago is nothing known
    known_nodes_.slots.assign(known_nodes_.slots.size(), {});
    known_corners_.slots.assign(known_corners_.slots.size(), {});
    call_ = 1;
  }
  nodes_.clear();
  corners_m_.clear();
  runs_.clear();
  // More than is usual, and no cap: once lists have been as long, no frame allocates.
  nodes_.reserve(patches.size());
  corners_m_.reserve(patches.size());
  moved_.reserve(patches.size());
  runs_.reserve(patches.size());
  const auto find_node = [&](glm::ivec2 place, int size, int level, double off_m) {
    std::uint32_t& node = known_nodes_.find(place, level, call_);
    if (node != unknown) return node;
    Node made{{}, off_m, true};
    for (unsigned c = 0; c < 4; ++c) {
      const glm::ivec2 at = place + size * glm::ivec2(c & 1u, c >> 1);
      std::uint32_t& corner = known_corners_.find(at, 0, call_);
      if (corner == unknown) {
        corner = static_cast<std::uint32_t>(corners_m_.size());
        corners_m_.push_back(selection.grid_origin_m + glm::dvec2(least + at) * selection.unit_m);
      }
      made.corners[c] = corner;
    }
    node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back(made);
    return node;
  };
  int stride = 0, level = 0, size = 0;
  double off_m = 0.0;
  glm::ivec2 last_place{0};
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const gpu::PatchInstance& patch = patches[n];
    const bool other = patch.stride != stride || (patch.flags & gpu::patch_skirt) != 0u;
    if (other) {
      const double size_m = patch.stride * gpu::patch_quads * selection.unit_m;
      if (size_m > most_m || (patch.flags & gpu::patch_skirt) != 0u) {
        stride = 0;
        if (runs_.empty() || runs_.back().node != unknown) runs_.push_back({n, unknown});
        continue;
      }
      stride = patch.stride;
      level = static_cast<int>(gpu::patch_level(patch.flags));
      size = node_patches * stride * gpu::patch_quads;
      off_m = scale * error(node_patches * size_m) + 0.01;
    }
    const glm::ivec2 place = (patch.corner - least) & -size;
    if (!other && place == last_place) continue;
    last_place = place;
    runs_.push_back({n, find_node(place, size, level, off_m)});
  }
  if (nodes_.empty()) return;
  moved_.resize(corners_m_.size());
  displace(field, tiles, corners_m_, moved_);
  for (Node& node : nodes_) {
    glm::dvec3 low(1e30), high(-1e30);
    for (const std::uint32_t corner : node.corners) {
      const glm::dvec2 rest = corners_m_[corner] - selection.grid_origin_m;
      const glm::dvec3 at = glm::dvec3(rest.x, 0.0, rest.y) + glm::dvec3(moved_[corner]);
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    const glm::dvec3 middle = 0.5 * (low + high), half = 0.5 * (high - low) + node.off_m;
    const double far_x = std::abs(middle.x - viewer.x) + half.x, far_z = std::abs(middle.z - viewer.y) + half.z;
    node.seen = frusta.may_see({middle.x, middle.z, half.x, half.z, low.y - node.off_m - curvature_drop(far_x * far_x + far_z * far_z), high.y + node.off_m});
  }
  auto kept = patches.begin();
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const std::size_t end = r + 1 < runs_.size() ? runs_[r + 1].first : patches.size();
    if (runs_[r].node != unknown && !nodes_[runs_[r].node].seen) continue;
    kept = std::copy(patches.begin() + static_cast<std::ptrdiff_t>(runs_[r].first), patches.begin() + static_cast<std::ptrdiff_t>(end), kept);
  }
  selection.culled_nodes += static_cast<int>(patches.end() - kept);
  patches.erase(kept, patches.end());
}

}  // namespace seascape
