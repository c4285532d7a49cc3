#include "ocean/lod/quadtree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

#include "engine/error.h"
#include "ocean/lod/horizon.h"
#include "shaders/shared/skirt.h"

namespace seascape {
namespace {

void require(bool good, const char* key, double value, const char* range) {
  if (!good)
    throw Error(fmt::format("lod.{}", key), fmt::format("is {}, outside {}", value, range),
                fmt::format("set lod.{} to {}", key, range), 2);
}

// Written so that NaN is out of every range.
void check(const LodSettings& s) {
  require(s.ocean_size_m >= 256.0 && s.ocean_size_m <= 8192.0, "ocean_size_m", s.ocean_size_m, "256 to 8192");
  require(s.patch_quads == 16 || s.patch_quads == 32 || s.patch_quads == 64, "patch_quads", s.patch_quads, "16, 32 or 64");
  require(s.threshold >= 0.5 && s.threshold <= 4.0, "threshold", s.threshold, "0.5 to 4");
  require(s.cull_scale >= 1.0 && s.cull_scale <= 4.0, "cull_scale", s.cull_scale, "1 to 4");
  require(s.levels >= 0 && s.levels <= Quadtree::max_square_levels, "levels", s.levels, "0 to 12");
  require(s.max_height_m >= 0.0 && s.max_height_m <= 200.0, "max_height_m", s.max_height_m, "0 to 200");
  require(s.skirt_multiplier >= 1.0 && s.skirt_multiplier <= 20.0, "skirt_multiplier", s.skirt_multiplier, "1 to 20");
}

// As many levels as bring the smallest squares to 6.8 m times the threshold or less: 8 m at high (0.125 m between
// vertices), 4 m at ultra. A level more shows only within a few metres of the eye.
int automatic_levels(const LodSettings& s) {
  int levels = 0;
  for (double size = s.ocean_size_m; levels < Quadtree::max_square_levels && size > 6.8 * s.threshold; size *= 0.5) ++levels;
  return levels;
}

// Levels of patches within one square.
int patch_levels(const LodSettings& s) { return std::countr_zero(static_cast<unsigned>(s.patch_quads / gpu::patch_quads)); }

// How far v lies outside of the interval, 0 inside.
int gap(int low, int high, int v) { return std::max({low - v, v - high, 0}); }

double curvature_drop(double distance_m) {
  return distance_m * distance_m / (2.0 * static_cast<double>(gpu::earth_radius_m));
}

}  // namespace

// Everything below is in units of unit_m unless named _m. The tree's own coordinates count from its least corner.
struct Quadtree::Frame {
  int root_size;
  int viewer_x, viewer_z;  // the viewer's grid point in the tree's coordinates
  double gap_y;            // between the viewer and the water's bounds
  glm::ivec2 least;        // the tree's least corner in the selection's coordinates
  glm::dvec2 viewer_m;     // the viewer relative to the grid origin
  double vertical_m, horizontal_m;
  int size(int level) const { return root_size >> level; }
};

void Quadtree::SplitWindow::set(int x, int z) {
  const unsigned dx = static_cast<unsigned>(x - x0), dz = static_cast<unsigned>(z - z0);
  assert(dx < width && dz < width);
  rows[dz] |= 1u << dx;
}

Quadtree::Quadtree(const LodSettings& settings) { apply(settings); }

void Quadtree::apply(const LodSettings& settings) {
  check(settings);
  LodSettings same_but_frozen = settings_;
  same_but_frozen.freeze = settings.freeze;
  const bool keeps = same_but_frozen == settings;
  settings_ = settings;
  if (keeps && selected_) return;
  selected_ = false;
  levels_ = (settings.levels > 0 ? settings.levels : automatic_levels(settings)) + patch_levels(settings);
  unit_m_ = settings.ocean_size_m / static_cast<double>(gpu::patch_quads << levels_);
  selection_.patches.reserve(static_cast<std::size_t>(256 * (levels_ + 1)));  // more than is usual; no cap
}

const SurfaceSelection& Quadtree::select(const Viewpoint& viewpoint, const DisplacementBounds& bounds) {
  const glm::dvec3 eye = viewpoint.viewer.position_m;
  if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z) ||
      std::max(std::abs(eye.x), std::abs(eye.z)) > std::ldexp(unit_m_, 50))
    throw Error("viewer", fmt::format("position ({}, {}, {}) m is not usable", eye.x, eye.y, eye.z),
                "keep the camera within 1e12 m of the origin");
  if (!(bounds.vertical_m >= 0.0 && bounds.horizontal_m >= 0.0 && bounds.vertical_m <= 1e6 && bounds.horizontal_m <= 1e6))
    throw Error("surface bounds", fmt::format("are {} and {} m, outside 0 to 1e6", bounds.vertical_m, bounds.horizontal_m),
                "check the sea state");
  const std::int64_t grid_x = std::llround(eye.x / unit_m_), grid_z = std::llround(eye.z / unit_m_);
  if (settings_.freeze && selected_) {
    move_frozen(grid_x, grid_z);
    return selection_;
  }
  grid_x_ = grid_x;
  grid_z_ = grid_z;
  selection_.unit_m = unit_m_;
  selection_.grid_origin_m = glm::dvec2(static_cast<double>(grid_x), static_cast<double>(grid_z)) * unit_m_;

  Frame frame{};
  frame.root_size = gpu::patch_quads << levels_;
  frame.vertical_m = settings_.max_height_m > 0.0 ? settings_.max_height_m : bounds.vertical_m;
  frame.horizontal_m = bounds.horizontal_m;
  frame.gap_y = std::max(std::abs(eye.y) - frame.vertical_m, 0.0) / unit_m_;
  const int spacing = centre_spacing(frame);
  const auto to_centre = [spacing](std::int64_t grid) {
    const int into = static_cast<int>(((grid % spacing) + spacing) % spacing);
    return into * 2 < spacing ? -into : spacing - into;
  };
  selection_.half_size = frame.root_size / 2;
  selection_.tree_centre = {to_centre(grid_x), to_centre(grid_z)};
  frame.least = selection_.tree_centre - selection_.half_size;
  frame.viewer_x = -frame.least.x;
  frame.viewer_z = -frame.least.y;
  frame.viewer_m = glm::dvec2(eye.x, eye.z) - selection_.grid_origin_m;

  selection_.horizon_m =
      std::max(horizon_distance(eye.y, frame.vertical_m, settings_.earth_curvature), settings_.ocean_size_m * 0.75);
  // The tree's centre may be half a spacing away from the viewer, and the grid point half a unit.
  const double off_centre_m = (static_cast<double>(spacing) + 1.0) * 0.5 * unit_m_;
  lay_skirt(frame, off_centre_m);

  selection_.patches.clear();
  selection_.visited_nodes = selection_.culled_nodes = selection_.skirt_strips = 0;
  frusta_.set(viewpoint.eyes, {selection_.grid_origin_m.x, 0.0, selection_.grid_origin_m.y});
  find_splits(frame);
  balance();
  select_tree(frame);
  select_skirt(frame);
  const int drop = settings_.drop_patch;
  if (drop >= 0 && drop < static_cast<int>(selection_.patches.size())) {
    if ((selection_.patches[static_cast<std::size_t>(drop)].flags & gpu::patch_skirt) != 0u) --selection_.skirt_strips;
    selection_.patches.erase(selection_.patches.begin() + drop);
  }
  selected_ = true;
  return selection_;
}

double Quadtree::patch_ratio() const { return gpu::patch_quads * spacing_over_distance(settings_); }

// Farther than this (in units) all that the water moves is below the error that a mesh may have.
double Quadtree::visible_reach(const Frame& frame) const {
  return frame.vertical_m / unit_m_ / (error_over_spacing * spacing_over_distance(settings_));
}

// Nearer than this (in units) the patches of a level split. The first levels always do: from high above, the border of a coarse
// tree would cut corners off the round horizon.
double Quadtree::split_reach(const Frame& frame, int level) const {
  if (level < least_levels) return frame.gap_y + 2.0 * frame.root_size;
  return std::min(frame.size(level) / patch_ratio(), visible_reach(frame));
}

// The tree's centre keeps to multiples of the vertex spacing of the coarsest leaves, so that the vertices of every leaf
// stay on one lattice of the world while the viewer moves. A level is coarser than all leaves if each of its nodes splits
// wherever the viewer stands within that spacing: then its corner nodes do, the farthest.
int Quadtree::centre_spacing(const Frame& frame) const {
  int coarsest = 0;
  for (; coarsest < levels_; ++coarsest) {
    const double reach = split_reach(frame, coarsest);
    const double off = coarsest == 0 ? 0.0 : 0.5 * frame.root_size - frame.size(coarsest) + 0.5 * (1 << (levels_ - coarsest - 1));
    if (!(reach * reach > frame.gap_y * frame.gap_y + 2.0 * off * off)) break;
  }
  return 1 << (levels_ - coarsest);
}

void Quadtree::find_splits(const Frame& frame) {
  for (int level = 0; level < levels_; ++level) {
    SplitWindow& window = splits_[static_cast<std::size_t>(level)];
    const int size = frame.size(level), last = (1 << level) - 1;
    const int cell_x = std::clamp(frame.viewer_x / size, 0, last), cell_z = std::clamp(frame.viewer_z / size, 0, last);
    window.x0 = cell_x - SplitWindow::width / 2;
    window.z0 = cell_z - SplitWindow::width / 2;
    window.rows = {};
    // Squared, so that whole numbers stay exact.
    const double reach = split_reach(frame, level), reach2 = reach * reach - frame.gap_y * frame.gap_y;
    if (!(reach2 > 0.0)) continue;
    const int cells = std::min(static_cast<int>(std::sqrt(reach2) / size), last) + 1;  // how far off a node may be that splits
    assert(cells + 3 < SplitWindow::width / 2);
    for (int z = std::max(cell_z - cells, 0); z <= std::min(cell_z + cells, last); ++z)
      for (int x = std::max(cell_x - cells, 0); x <= std::min(cell_x + cells, last); ++x) {
        const double dx = gap(x * size, (x + 1) * size, frame.viewer_x), dz = gap(z * size, (z + 1) * size, frame.viewer_z);
        if (dx * dx + dz * dz < reach2) window.set(x, z);
      }
  }
}

// Two leaves that share an edge differ by at most one level exactly if every edge neighbour of a split node exists, that
// is, if the neighbour's parent is split. From the deepest level upwards one sweep is enough, because a sweep only adds
// splits one level up. A ring of e cells about the viewer's cell needs at most (e + 1 + 1) / 2 one level up: no more than
// that level's own splits and one, inside the window.
void Quadtree::balance() {
  for (int level = levels_ - 1; level > 0; --level) {
    const SplitWindow& fine = splits_[static_cast<std::size_t>(level)];
    SplitWindow& coarse = splits_[static_cast<std::size_t>(level - 1)];
    const int last = (1 << level) - 1;
    for (int dz = 0; dz < SplitWindow::width; ++dz) {
      const unsigned row = fine.rows[static_cast<std::size_t>(dz)];
      for (int dx = 0; (row >> dx) != 0u; ++dx) {
        if (((row >> dx) & 1u) == 0u) continue;
        const int x = fine.x0 + dx, z = fine.z0 + dz;
        coarse.set(x >> 1, z >> 1);
        coarse.set(std::max(x - 1, 0) >> 1, z >> 1);
        coarse.set(std::min(x + 1, last) >> 1, z >> 1);
        coarse.set(x >> 1, std::max(z - 1, 0) >> 1);
        coarse.set(x >> 1, std::min(z + 1, last) >> 1);
      }
    }
  }
}

// The edge bits of a leaf: a side has a coarser neighbour if the neighbour of the leaf's own size does not exist, that is,
// if that one's parent is not split. Outside the root there is no coarser one.
unsigned Quadtree::coarser_edges(int level, int x, int z) const {
  if (level == 0) return 0u;
  const SplitWindow& above = splits_[static_cast<std::size_t>(level - 1)];
  const int last = (1 << level) - 1;
  unsigned edges = 0u;
  if ((x & 1) != 0) {
    if (x < last && !above.get((x + 1) >> 1, z >> 1)) edges |= gpu::patch_east;
  } else if (x > 0 && !above.get((x - 1) >> 1, z >> 1)) {
    edges |= gpu::patch_west;
  }
  if ((z & 1) != 0) {
    if (z < last && !above.get(x >> 1, (z + 1) >> 1)) edges |= gpu::patch_north;
  } else if (z > 0 && !above.get(x >> 1, (z - 1) >> 1)) {
    edges |= gpu::patch_south;
  }
  return edges;
}

// A node's bounds are its square grown by the displacement times cull_scale. They hold its children's, so what is culled
// takes all that is below it along.
bool Quadtree::node_may_be_seen(const Frame& frame, int level, int x, int z) const {
  const int size = frame.size(level);
  const double half_m = 0.5 * size * unit_m_;
  const glm::dvec2 centre = glm::dvec2(frame.least + glm::ivec2(x, z) * size) * unit_m_ + half_m;
  // 1 cm for what fp32 loses between here and the screen.
  const double half_xz = half_m + frame.horizontal_m * settings_.cull_scale + 0.01;
  double low = -frame.vertical_m * settings_.cull_scale - 0.01, high = -low;
  if (settings_.earth_curvature) {
    const glm::dvec2 away = glm::abs(centre - frame.viewer_m);
    high -= curvature_drop(glm::length(glm::max(away - half_xz, glm::dvec2(0.0))));
    low -= curvature_drop(glm::length(away + half_xz));
  }
  return frusta_.may_see_box({centre.x, 0.5 * (low + high), centre.y}, {half_xz, 0.5 * (high - low), half_xz});
}

void Quadtree::select_tree(const Frame& frame) {
  struct Node {
    int level, x, z;
  };
  // Depth first: every level leaves at most three siblings behind.
  std::array<Node, 3 * max_levels + 1> stack;
  std::size_t count = 0;
  stack[count++] = {0, 0, 0};
  while (count > 0) {
    const Node node = stack[--count];
    ++selection_.visited_nodes;
    if (!node_may_be_seen(frame, node.level, node.x, node.z)) {
      ++selection_.culled_nodes;
      continue;
    }
    const int size = frame.size(node.level);
    if (node.level == levels_ || !splits_[static_cast<std::size_t>(node.level)].get(node.x, node.z)) {
      selection_.patches.push_back({frame.least + glm::ivec2(node.x, node.z) * size, size / gpu::patch_quads,
                                    coarser_edges(node.level, node.x, node.z) |
                                        (static_cast<unsigned>(node.level) << gpu::patch_level_shift)});
      continue;
    }
    // The quarter nearest the viewer is drawn first, the opposite one last: nearer water hides what follows.
    const int near_x = frame.viewer_x >= node.x * size + size / 2 ? 1 : 0;
    const int near_z = frame.viewer_z >= node.z * size + size / 2 ? 1 : 0;
    for (int quarter = 3; quarter >= 0; --quarter)
      stack[count++] = {node.level + 1, node.x * 2 + (near_x ^ (quarter & 1)), node.z * 2 + (near_z ^ (quarter >> 1))};
  }
}

// Dense as the patches only as far as the water's motion can be seen. Rows may be up to 13 % of their distance apart: the
// highest of them then stands within 0.01 degrees of the horizon from 10 km (its dip times the square of half of that, halved).
void Quadtree::lay_skirt(const Frame& frame, double off_centre_m) {
  const double half_m = settings_.ocean_size_m * 0.5;
  const double dense = std::clamp(visible_reach(frame) * unit_m_ / half_m, 1.0, settings_.skirt_multiplier);
  const double reach = (selection_.horizon_m + off_centre_m) / half_m;
  const double rows = std::log(std::max(dense, reach)) / std::log(1.13);
  selection_.skirt_to_multiplier = static_cast<float>(dense);
  selection_.skirt_to_horizon = static_cast<float>(reach);
  selection_.skirt_rows = std::clamp(static_cast<int>(std::ceil(rows / gpu::patch_quads)), 1, 48 / gpu::patch_quads) * gpu::patch_quads;
}

void Quadtree::select_skirt(const Frame& frame) {
  const auto bands = static_cast<unsigned>(selection_.skirt_rows / gpu::patch_quads);
  for (unsigned band = 0; band < bands; ++band)
    for (unsigned side = 0; side < 4; ++side)
      for (int along = 0; along < frame.root_size;) {
        int level = 0;
        for (; level < levels_; ++level) {
          const int last = (1 << level) - 1, cell = along / frame.size(level);
          const int x = side == 0 ? last : side == 2 ? 0 : cell, z = side == 1 ? last : side == 3 ? 0 : cell;
          if (!splits_[static_cast<std::size_t>(level)].get(x, z)) break;
        }
        select_strip(frame, side, level, along, band);
        along += frame.size(level);
      }
}

// The strip outside the leaf of `level` that begins `along` units from the least end of the root's side, a band of its
// rows. Its bounds are the trapezoid that it covers, grown by the displacement times cull_scale.
void Quadtree::select_strip(const Frame& frame, unsigned side, int level, int along, unsigned band) {
  const int size = frame.size(level), half = selection_.half_size;
  const int across = side < 2 ? half : -half;
  const auto on_side = [&](int t) { return side % 2 == 0 ? glm::ivec2(across, t - half) : glm::ivec2(t - half, across); };
  const glm::dvec2 first(on_side(along)), second(on_side(along + size));
  const auto reach = [&](unsigned row) {
    return static_cast<double>(gpu::skirt_scale(static_cast<int>(row), selection_.skirt_rows, selection_.skirt_to_multiplier,
                                                selection_.skirt_to_horizon));
  };
  const double inner = reach(band * gpu::patch_quads) * 0.999, outer = reach((band + 1) * gpu::patch_quads) * 1.001;
  const glm::dvec2 centre(selection_.tree_centre);
  const std::array<glm::dvec2, 4> corners{(centre + first * inner) * unit_m_, (centre + second * inner) * unit_m_,
                                          (centre + first * outer) * unit_m_, (centre + second * outer) * unit_m_};
  const double grow = frame.horizontal_m * settings_.cull_scale + 0.01;
  double low = -frame.vertical_m * settings_.cull_scale - 0.01, high = -low;
  if (settings_.earth_curvature) {
    double farthest = 0.0;
    for (const glm::dvec2& corner : corners) farthest = std::max(farthest, glm::length(corner - frame.viewer_m));
    low -= curvature_drop(farthest + 1.5 * grow) * 1.000001;
    const double nearest = std::abs((side % 2 == 0 ? corners[0].x - frame.viewer_m.x : corners[0].y - frame.viewer_m.y));
    high -= curvature_drop(std::max(nearest - grow, 0.0));
  }
  ++selection_.visited_nodes;
  if (!frusta_.may_see_prism(corners, grow, low, high)) {
    ++selection_.culled_nodes;
    return;
  }
  ++selection_.skirt_strips;
  selection_.patches.push_back({selection_.tree_centre + on_side(along), size / gpu::patch_quads,
                                gpu::patch_skirt | (side << gpu::patch_skirt_side_shift) | (band << gpu::patch_skirt_band_shift) |
                                    (static_cast<unsigned>(level) << gpu::patch_level_shift)});
}

void Quadtree::move_frozen(std::int64_t grid_x, std::int64_t grid_z) {
  const std::int64_t dx = grid_x_ - grid_x, dz = grid_z_ - grid_z;
  constexpr std::int64_t most = std::int64_t{1} << 30;
  const std::int64_t x = selection_.tree_centre.x + dx, z = selection_.tree_centre.y + dz;
  if (x < -most || x > most || z < -most || z > most)
    throw Error("lod.freeze", "the viewer is more than 2^30 units away from where the patches were frozen",
                "set lod.freeze to false");
  const glm::ivec2 move(static_cast<int>(dx), static_cast<int>(dz));
  for (gpu::PatchInstance& patch : selection_.patches) patch.corner += move;
  selection_.tree_centre += move;
  grid_x_ = grid_x;
  grid_z_ = grid_z;
  selection_.grid_origin_m = glm::dvec2(static_cast<double>(grid_x), static_cast<double>(grid_z)) * unit_m_;
}

}  // namespace seascape
