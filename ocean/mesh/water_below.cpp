#include "ocean/mesh/water_below.h"

#include <algorithm>
#include <cmath>

#include "ocean/mesh/tree_frame.h"
#include "ocean/sea/query_simd.h"

namespace seascape {

std::optional<DisplacementBounds::Below> water_below(const WaveField& field, const WaveTiles& tiles,
                                                     const glm::dvec3& viewer_m, const NearMotion& motion) {
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

std::uint32_t WaterCulling::corner(std::size_t n, int x, int z, const TreeFrame& frame, glm::dvec2 grid_origin_m) {
  const auto of = [this](const Grid& g, int to_x, int to_z) -> std::uint32_t& {
    return corners_[g.first_corner + static_cast<std::size_t>((to_z - g.z0) * (g.columns + 1) + to_x - g.x0)];
  };
  const Grid& grid = grids_[n];
  std::uint32_t& number = of(grid, x, z);
  if (number != unknown) return number;
  if (n > 0) {
    const Grid& finer = grids_[n - 1];
    const int in_x = 2 * x - finer.x0, in_z = 2 * z - finer.z0;
    if (2 * finer.size == grid.size && in_x >= 0 && in_z >= 0 && in_x <= finer.columns && in_z <= finer.rows)
      number = of(finer, 2 * x, 2 * z);
    if (number != unknown) return number;
  }
  number = static_cast<std::uint32_t>(rest_m_.size());
  rest_m_.push_back(grid_origin_m + glm::dvec2(frame.least + grid.size * glm::ivec2(x, z)) * frame.unit_m);
  return number;
}

// A node is seen as soon as the box about some of its corners is, since the box about all of them holds that one: so
// most nodes need one corner only, that of the lattice twice as wide, which four nodes share.
void WaterCulling::operator()(const WaveField& field, const WaveTiles& tiles, const EyeFrusta& frusta,
                              const TreeFrame& frame, const glm::dvec2& grid_origin_m, std::span<const LeafRun> runs,
                              std::span<LeafLevel> levels) {
  // Larger leaves culling by bounds leaves out nearly as well: up to half the height instead, in an open sea of 2 m at
  // low, takes a fifth longer and leaves out four patches of a hundred more.
  const double most_m = 0.4 * 4.0 * std::sqrt(field.statistics().height_variance);
  constexpr std::size_t few =
      24;  // of so many all corners are asked at once: to begin with the first would take longer
  const MeshError& error = field.statistics().mesh_error;
  grids_.clear();
  std::size_t nodes = 0, corners = 0;
  for (const LeafLevel& level : levels) {
    const double leaf_m = level.size * frame.unit_m;
    if (leaf_m > most_m) break;  // finer levels come first
    const int x0 = level.columns.first >> LeafLevel::node_shift, z0 = level.rows.first >> LeafLevel::node_shift;
    const int columns = (level.columns.last >> LeafLevel::node_shift) - x0 + 1,
              rows = (level.rows.last >> LeafLevel::node_shift) - z0 + 1;
    grids_.push_back({level.size << LeafLevel::node_shift, x0, z0, columns, rows, nodes, corners,
                      error(LeafLevel::node_leaves * leaf_m) + 0.01});
    nodes += static_cast<std::size_t>(columns * rows);
    corners += static_cast<std::size_t>((columns + 1) * (rows + 1));
  }
  // More than is usual, and no cap: once as many were there, no frame allocates.
  const auto room = [](auto& of, std::size_t count) {
    if (of.capacity() < count) of.reserve(2 * count);
  };
  room(seen_, nodes);
  room(left_, nodes);
  room(corners_, corners);
  room(rest_m_, corners);
  room(moved_m_, corners);
  room(asked_, 3 * nodes + 4 * few);
  left_.clear();
  rest_m_.clear();
  moved_m_.clear();
  seen_.assign(nodes, 0);
  corners_.assign(corners, unknown);
  for (std::size_t n = 0; n < grids_.size(); ++n) {
    const Grid& grid = grids_[n];
    LeafLevel& level = levels[n];
    level.seen = seen_;
    level.pitch = grid.columns;
    level.first_node = static_cast<std::ptrdiff_t>(grid.first_node) - grid.z0 * level.pitch - grid.x0;
    for (const LeafRun& run : runs.subspan(level.first_run, level.end_run - level.first_run)) {
      const std::ptrdiff_t row = level.first_node + (run.z >> LeafLevel::node_shift) * level.pitch;
      for (int x = run.first >> LeafLevel::node_shift; x <= run.last >> LeafLevel::node_shift; ++x) {
        const std::ptrdiff_t at = row + x;
        if (seen_[static_cast<std::size_t>(at)] != 0) continue;
        seen_[static_cast<std::size_t>(at)] = 1;
        left_.push_back({static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(n), x,
                         run.z >> LeafLevel::node_shift, glm::dvec3(1e30), glm::dvec3(-1e30)});
      }
    }
  }
  if (left_.empty()) return;
  const QueryPlan plan = plan_queries(field, tiles, {});
  for (unsigned from = 0, to = left_.size() <= few ? 4 : 1; from < 4 && !left_.empty(); from = to, to = 4) {
    asked_.clear();
    for (const Node& node : left_) {
      const unsigned first = (static_cast<unsigned>(node.x) & 1u) | (static_cast<unsigned>(node.z) & 1u) << 1;
      for (unsigned c = from; c < to; ++c) {
        const unsigned of = first ^ c;
        asked_.push_back(corner(node.grid, node.x + static_cast<int>(of & 1u), node.z + static_cast<int>(of >> 1),
                                frame, grid_origin_m));
      }
    }
    const std::size_t before = moved_m_.size();
    moved_m_.resize(rest_m_.size());
    displace_points(plan, rest_m_.data() + before, moved_m_.data() + before, rest_m_.size() - before);
    auto asked = asked_.begin();
    auto left = left_.begin();
    for (Node& node : left_) {
      for (unsigned c = from; c < to; ++c, ++asked) {
        const glm::dvec2 rest = rest_m_[*asked] - grid_origin_m;
        const glm::dvec3 at = glm::dvec3(rest.x, 0.0, rest.y) + glm::dvec3(moved_m_[*asked]);
        node.low = glm::min(node.low, at);
        node.high = glm::max(node.high, at);
      }
      const double off_m = grids_[node.grid].off_m;
      const glm::dvec3 middle = 0.5 * (node.low + node.high), half = 0.5 * (node.high - node.low) + off_m;
      const double far_x = std::abs(middle.x - frame.viewer_m.x) + half.x,
                   far_z = std::abs(middle.z - frame.viewer_m.y) + half.z;
      const bool seen =
          frusta.may_see({middle.x, middle.z, half.x, half.z,
                          node.low.y - off_m - curvature_drop(far_x * far_x + far_z * far_z), node.high.y + off_m});
      seen_[node.at] = seen ? 1 : 0;
      if (!seen) *left++ = node;
    }
    left_.erase(left, left_.end());
  }
}

}  // namespace seascape
