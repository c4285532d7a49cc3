#include "ocean/lod/quadtree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fmt/format.h>

#include "engine/error.h"
#include "ocean/lod/horizon.h"
#include "ocean/lod/skirt_strips.h"

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

// The tree's centre keeps to multiples of the vertex spacing of the coarsest leaves, so that the vertices of every leaf
// stay on one lattice of the world while the viewer moves. A level is coarser than all leaves if each of its nodes splits
// wherever the viewer stands within that spacing: then its corner nodes do, the farthest.
int centre_spacing(const TreeFrame& frame) {
  int coarsest = 0;
  for (; coarsest < frame.levels; ++coarsest) {
    const double reach = frame.split_reach(coarsest);
    const double off = coarsest == 0 ? 0.0 : 0.5 * frame.root_size - frame.size(coarsest) + 0.5 * (1 << (frame.levels - coarsest - 1));
    if (!(reach * reach > frame.gap_y * frame.gap_y + 2.0 * off * off)) break;
  }
  return 1 << (frame.levels - coarsest);
}

}  // namespace

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

  TreeFrame frame;
  frame.levels = levels_;
  frame.root_size = gpu::patch_quads << levels_;
  frame.unit_m = unit_m_;
  frame.curved = settings_.earth_curvature;
  const double vertical_m = settings_.max_height_m > 0.0 ? settings_.max_height_m : bounds.vertical_m;
  // 1 cm for what fp32 loses between here and the screen.
  frame.rise_m = vertical_m * settings_.cull_scale + 0.01;
  frame.shift_m = bounds.horizontal_m * settings_.cull_scale + 0.01;
  frame.gap_y = std::max(std::abs(eye.y) - vertical_m, 0.0) / unit_m_;
  const double spacing_ratio = spacing_over_distance(settings_);
  frame.ratio = gpu::patch_quads * spacing_ratio;
  frame.morphed = settings_.join == LodJoin::morphed;
  if (frame.morphed) frame.ratio = std::min(frame.ratio, TreeFrame::most_morphed_ratio);
  frame.visible_reach = vertical_m / unit_m_ / (error_over_spacing * spacing_ratio);
  const int coarsest = centre_spacing(frame);
  // Vertices of the coarsest leaves may slide too; which of them are odd must not change while the viewer moves.
  const int last_stride = frame.morphed ? std::min(coarsest, frame.root_size / gpu::patch_quads >> (TreeFrame::least_levels + 1)) : 0;
  const int spacing = std::max(coarsest, 2 * last_stride);
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

  // A node that splits has 16 of its quarters' strides a side.
  constexpr double strides = 2.0 * gpu::patch_quads;
  selection_.morph = {glm::vec2(frame.viewer_m / unit_m_), static_cast<float>(frame.gap_y),
                      frame.visible_reach > 0.0 ? static_cast<float>(strides / frame.ratio) : 0.0f,
                      static_cast<float>(std::min(frame.visible_reach, 1e9)), static_cast<float>(TreeFrame::morph_step * strides),
                      last_stride, 0.0f};

  selection_.horizon_m = std::max(horizon_distance(eye.y, vertical_m, settings_.earth_curvature), settings_.ocean_size_m * 0.75);
  // The tree's centre may be half a spacing away from the viewer, and the grid point half a unit.
  const double off_centre_m = (static_cast<double>(spacing) + 1.0) * 0.5 * unit_m_;
  lay_skirt(frame, settings_.skirt_multiplier, selection_.horizon_m + off_centre_m, selection_);

  selection_.patches.clear();
  selection_.visited_nodes = selection_.culled_nodes = selection_.skirt_strips = 0;
  frusta_.set(viewpoint.eyes, {selection_.grid_origin_m.x, 0.0, selection_.grid_origin_m.y});
  splits_.find(frame);
  select_tree(frame);
  select_skirt(frame, splits_, frusta_, selection_);
  const int drop = settings_.drop_patch;
  if (drop >= 0 && drop < static_cast<int>(selection_.patches.size())) {
    if ((selection_.patches[static_cast<std::size_t>(drop)].flags & gpu::patch_skirt) != 0u) --selection_.skirt_strips;
    selection_.patches.erase(selection_.patches.begin() + drop);
  }
  selected_ = true;
  return selection_;
}

// A node's bounds are its square grown by the displacement times cull_scale. They hold its quarters', so what is culled takes all
// that is below it along, and what an eye sees wholly is not asked about again. The root is not asked about: it reaches beneath the viewer.
void Quadtree::select_tree(const TreeFrame& frame) {
  struct Node {
    gpu::PatchInstance patch;  // as it is drawn if it is a leaf
    EyeFrusta::Questions questions;
    bool splits;
  };
  // Depth first: every level leaves at most three siblings behind. One more to write to.
  std::array<Node, 3 * max_levels + 2> stack;
  std::size_t count = 0;
  stack[count++] = {{frame.least, frame.root_size / gpu::patch_quads, 0u}, frusta_.all(), splits_.split(0, 0, 0)};
  const unsigned edges = frame.morphed ? 0u : gpu::patch_east | gpu::patch_north | gpu::patch_west | gpu::patch_south;
  int visited = 1, culled = 0;
  QuarterBoxes boxes{.rise = frame.rise_m, .viewer_x = frame.viewer_m.x, .viewer_z = frame.viewer_m.y,
                     .curve = frame.curved ? curvature_drop(1.0) : 0.0};
  std::array<EyeFrusta::Questions, 4> questions;
  while (count > 0) {
    const Node& top = stack[--count];
    if (!top.splits) {
      selection_.patches.push_back(top.patch);
      continue;
    }
    const glm::ivec2 corner = top.patch.corner;
    const int stride = top.patch.stride / 2, half = stride * gpu::patch_quads, level = static_cast<int>(gpu::patch_level(top.patch.flags));
    const EyeFrusta::Questions asked = top.questions;
    unsigned seen = 15;
    questions = {};
    if (asked != EyeFrusta::none) {
      boxes.step = half * frame.unit_m;
      boxes.x = corner.x * frame.unit_m + 0.5 * boxes.step;
      boxes.z = corner.y * frame.unit_m + 0.5 * boxes.step;
      boxes.half = 0.5 * boxes.step + frame.shift_m;
      seen = frusta_.may_see(boxes, asked, questions);
    }
    visited += 4;
    culled += 4 - std::popcount(seen);
    const glm::ivec2 in_tree = corner - frame.least;
    const int shift = std::countr_zero(static_cast<unsigned>(half)) + 1;
    const SplitMap::Brood brood = splits_.brood(level, in_tree.x >> shift, in_tree.y >> shift);
    const unsigned flags = static_cast<unsigned>(level + 1) << gpu::patch_level_shift;
    // The quarter nearest the viewer is drawn first, the opposite one last: nearer water hides what follows.
    const unsigned nearest = (frame.viewer_x >= in_tree.x + half ? 1u : 0u) | (frame.viewer_z >= in_tree.y + half ? 2u : 0u);
    for (unsigned turn = 4; turn-- > 0;) {
      const unsigned quarter = nearest ^ turn;
      // Put there even if no eye sees it, and then overwritten: whether one does cannot be guessed.
      stack[count] = {{{corner.x + ((quarter & 1u) != 0u ? half : 0), corner.y + ((quarter & 2u) != 0u ? half : 0)}, stride,
                       flags | (brood.coarser & SplitMap::outer_edges[quarter] & edges)}, questions[quarter], ((brood.splits >> quarter) & 1u) != 0u};
      count += (seen >> quarter) & 1u;
    }
  }
  selection_.visited_nodes += visited;
  selection_.culled_nodes += culled;
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
  selection_.morph.viewer += glm::vec2(move);
  grid_x_ = grid_x;
  grid_z_ = grid_z;
  selection_.grid_origin_m = glm::dvec2(static_cast<double>(grid_x), static_cast<double>(grid_z)) * unit_m_;
}

}  // namespace seascape
