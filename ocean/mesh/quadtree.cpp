#include "ocean/mesh/quadtree.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cmath>

#include "engine/error.h"
#include "ocean/mesh/horizon.h"
#include "ocean/mesh/skirt_strips.h"
#include "ocean/mesh/water_below.h"

namespace seascape {
namespace {

// How many standard deviations the water about the viewer may be off the smoothed water beneath: where levels need the
// nearest water, and where culling must not lose any (Rayleigh: exp(-c^2 / 2) = 1e-6, and a tenth more).
constexpr double crest_deviations = 2.5, near_deviations = 5.8;

// By how much farther away masked joins split: they change at once, and then water moves along the surface as well as
// off it, by up to so many times what the mesh misses.
constexpr double masked_early = 1.75;

// Levels measure distances between places at rest, from where water may have come closer. The largest product of two
// normal numbers, an error of its mean and c deviations, and one over a distance of its mean and some deviations, of s
// of it each, has the error grow by (c s)^2 / 2: here c is 5.4 at one pixel, as mesh_error's, whose factors were fitted
// on waters that come closer by some twentieth: what is more counts. Measured: without, near water in a storm missed by
// up to 1.12 of the figure, from a seventh less distance.
double closer(double distance_m, double moved_m, double fewer) {
  constexpr double peak = 5.4, fitted = 0.06, most = 1.0;
  const double s = moved_m / distance_m, half_peak2 = 0.5 * peak * peak * fewer * fewer;
  return s > fitted ? distance_m * std::min(half_peak2 * (s * s - fitted * fitted), most * s) : 0.0;
}

void require(bool good, const char* key, double value, const char* range) {
  if (!good)
    throw Error(fmt::format("lod.{}", key), fmt::format("is {}, outside {}", value, range),
                fmt::format("set lod.{} to {}", key, range), 2);
}

// Written so that NaN is out of every range.
void check(const LodSettings& s) {
  require(s.ocean_size_m >= 256.0 && s.ocean_size_m <= 8192.0, "ocean_size_m", s.ocean_size_m, "256 to 8192");
  require(s.patch_quads == 16 || s.patch_quads == 32 || s.patch_quads == 64, "patch_quads", s.patch_quads,
          "16, 32 or 64");
  require(s.pixel_error >= 0.25 && s.pixel_error <= 64.0, "pixel_error", s.pixel_error, "0.25 to 64");
  require(s.threshold >= 0.5 && s.threshold <= 4.0, "threshold", s.threshold, "0.5 to 4");
  require(s.cull_scale >= 1.0 && s.cull_scale <= 4.0, "cull_scale", s.cull_scale, "1 to 4");
  require(s.levels >= 0 && s.levels <= Quadtree::max_square_levels, "levels", s.levels, "0 to 12");
  require(s.max_height_m >= 0.0 && s.max_height_m <= 200.0, "max_height_m", s.max_height_m, "0 to 200");
  require(s.skirt_multiplier >= 1.0 && s.skirt_multiplier <= 20.0, "skirt_multiplier", s.skirt_multiplier, "1 to 20");
}

bool by_pixels(const LodSettings& s) { return s.by == LodLaw::pixel_error; }

// As many levels as bring vertices to what is needed a quarter of a metre from the eye, 4 mm a pixel of error in a
// rough sea; levels that neither eye nor sea needs cost nothing.
int automatic_levels(const LodSettings& s) {
  const double needed_m = by_pixels(s) ? 0.004 * s.pixel_error : 0.25 * Quadtree::spacing_over_distance(s);
  const int most = Quadtree::max_levels - std::countr_zero(static_cast<unsigned>(s.patch_quads / gpu::patch_quads));
  int levels = 0;
  for (double size = s.ocean_size_m; levels < most && size > needed_m * s.patch_quads; size *= 0.5) ++levels;
  return levels;
}

// Levels of patches within one square.
int patch_levels(const LodSettings& s) {
  return std::countr_zero(static_cast<unsigned>(s.patch_quads / gpu::patch_quads));
}

// The tree's centre keeps to multiples of the vertex spacing of the coarsest leaves, so that the vertices of every leaf
// stay on one lattice of the world while the viewer moves. A level is coarser than all leaves if each of its nodes
// splits wherever the viewer stands within that spacing: then its corner nodes do, the farthest.
int centre_spacing(const TreeFrame& frame) {
  int coarsest = 0;
  for (; coarsest < frame.levels; ++coarsest) {
    const double reach = frame.split_reach(coarsest);
    const double off =
        coarsest == 0 ? 0.0 : 0.5 * frame.root_size - frame.size(coarsest) + 0.5 * (1 << (frame.levels - coarsest - 1));
    if (!(reach * reach > frame.gap_y * frame.gap_y + 2.0 * off * off)) break;
  }
  return 1 << (frame.levels - coarsest);
}

// VertexMorph::spacing of the levels from `first` on: where levels change, spacings over distances. Their bound is the
// line through the finest levels, and a parabola above the others as far as slopes of waves matter.
glm::dvec3 spacing_from(const TreeFrame& frame, int first) {
  constexpr double most_m = 400.0;
  double least = 1.0, line = 0.0, growth = 0.0;
  for (int n = first; n < frame.levels; ++n) {
    const double distance = frame.reach[static_cast<std::size_t>(n)], ratio = (2 << n) / distance;
    if (!(distance > frame.gap_y)) continue;
    least = std::min(least, ratio);
    if (n < first + 3)
      line = std::max(line, ratio);
    else if (distance * frame.unit_m < most_m)
      growth = std::max(growth, (ratio - line) / distance);
  }
  return {least, std::max(line, least), growth};
}

// A viewer who rises leaves the finest levels behind one by one, each while all of its vertices slide to the next: what
// is averaged follows, so that no frame changes the whole picture at once.
glm::vec4 spacing_of(const TreeFrame& frame) {
  int first = 0;
  while (first < frame.levels && !(frame.reach[static_cast<std::size_t>(first)] > frame.gap_y)) ++first;
  const glm::dvec3 whole = spacing_from(frame, first);
  if (first >= frame.levels) return glm::vec4(glm::vec3(whole), 0.0f);
  const double reach = frame.reach[static_cast<std::size_t>(first)],
               before = first > 0 ? frame.reach[static_cast<std::size_t>(first - 1)] : 0.5 * reach;
  const double left =
      std::min(2.0 * (reach - frame.gap_y) / (reach - before), 1.0);  // as vertices slide (morphed() in vertex_morph.h)
  return left < 1.0 ? glm::vec4(glm::vec3(glm::mix(spacing_from(frame, first + 1), whole, left)), 0.0f)
                    : glm::vec4(glm::vec3(whole), 0.0f);
}

// Throws Error where a viewer (m) or bounds cannot be worked with, in a tree whose smallest length is `unit_m`.
void expect_usable(const glm::dvec3& eye, const DisplacementBounds& bounds, double unit_m) {
  if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z) ||
      std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}) > std::ldexp(unit_m, 50))
    throw Error("viewer", fmt::format("position ({}, {}, {}) m is not usable", eye.x, eye.y, eye.z),
                "keep the camera within 1e12 m of the origin");
  if (!(bounds.vertical_m >= 0.0 && bounds.horizontal_m >= 0.0 && bounds.vertical_m <= 1e6 &&
        bounds.horizontal_m <= 1e6))
    throw Error("surface bounds",
                fmt::format("are {} and {} m, outside 0 to 1e6", bounds.vertical_m, bounds.horizontal_m),
                "check the sea state");
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
  selected_ = reaches_.known = false;
  levels_ = (settings.levels > 0 ? settings.levels : automatic_levels(settings)) + patch_levels(settings);
  unit_m_ = settings.ocean_size_m / static_cast<double>(gpu::patch_quads << levels_);
  selection_.patches.reserve(static_cast<std::size_t>(256 * (levels_ + 1)));  // more than is usual; no cap
}

const SurfaceSelection& Quadtree::select(const Viewpoint& viewpoint, const MeshWater& water) {
  const DisplacementBounds& bounds = water.bounds;
  const glm::dvec3 eye = viewpoint.viewer.position_m;
  expect_usable(eye, bounds, unit_m_);
  const std::int64_t grid_x = std::llround(eye.x / unit_m_), grid_z = std::llround(eye.z / unit_m_);
  if (settings_.freeze && selected_) {
    move_frozen(grid_x, grid_z);
    return selection_;
  }
  grid_x_ = grid_x;
  grid_z_ = grid_z;
  selection_.unit_m = unit_m_;
  selection_.mesh.unit_m = static_cast<float>(unit_m_);
  selection_.grid_origin_m = glm::dvec2(static_cast<double>(grid_x), static_cast<double>(grid_z)) * unit_m_;

  TreeFrame frame;
  frame.unit_m = unit_m_;
  frame.curved = settings_.earth_curvature;
  const double vertical_m = settings_.max_height_m > 0.0 ? settings_.max_height_m : bounds.vertical_m;
  // 1 cm for what fp32 loses between here and the screen.
  frame.rise_m = vertical_m * settings_.cull_scale + 0.01;
  frame.shift_m = bounds.horizontal_m * settings_.cull_scale + 0.01;
  frame.gap_y = std::max(std::abs(eye.y) - vertical_m, 0.0) / unit_m_;
  glm::dvec2 centre_m(eye.x, eye.z);  // that levels follow
  if (bounds.below) {
    centre_m = bounds.below->rest_m;
    const double over_m = std::abs(eye.y - bounds.below->displacement_m.y);
    frame.gap_y =
        std::max(frame.gap_y,
                 (over_m - crest_deviations * bounds.below->motion(over_m).x - bounds.below->off(over_m).x) / unit_m_);
  }
  const glm::i64vec2 centre(std::llround(centre_m.x / unit_m_), std::llround(centre_m.y / unit_m_));
  const glm::ivec2 to_viewer(static_cast<int>(centre.x - grid_x), static_cast<int>(centre.y - grid_z));
  const Reaches::Asked asked{
      viewpoint.pixels_per_radian > 0.0 ? viewpoint.pixels_per_radian : reference_pixels_per_radian,
      vertical_m,
      bounds.mesh_error,
      bounds.near,
      bounds.near.empty() ? 0.0 : std::abs(eye.y) + vertical_m,
      bounds.below ? std::optional(bounds.below->motion) : std::nullopt};
  if (!(reaches_.known && reaches_.asked == asked && std::ranges::equal(reaches_.near, asked.near)))
    find_reaches(asked);
  frame.levels = reaches_.levels;
  frame.root_size = gpu::patch_quads << frame.levels;
  frame.reach = reaches_.reach;
  frame.border_spacing = reaches_.border_spacing;
  frame.visible_reach = reaches_.visible;
  const int coarsest = centre_spacing(frame);
  // Vertices of the coarsest leaves may slide too; which of them are odd must not change while the viewer moves.
  const int last_stride = settings_.join == LodJoin::morphed
                              ? std::min(coarsest, frame.root_size / gpu::patch_quads >> (TreeFrame::least_levels + 1))
                              : 0;
  const int spacing = std::max(coarsest, 2 * last_stride);
  const auto to_centre = [spacing](std::int64_t grid) {
    const int into = static_cast<int>(((grid % spacing) + spacing) % spacing);
    return into * 2 < spacing ? -into : spacing - into;
  };
  selection_.half_size = frame.root_size / 2;
  selection_.mesh.tree_centre = to_viewer + glm::ivec2(to_centre(centre.x), to_centre(centre.y));
  frame.least = selection_.mesh.tree_centre - selection_.half_size;
  frame.viewer_x = to_viewer.x - frame.least.x;
  frame.viewer_z = to_viewer.y - frame.least.y;
  frame.viewer_m = glm::dvec2(eye.x, eye.z) - selection_.grid_origin_m;

  selection_.mesh.morph = {glm::vec2((centre_m - selection_.grid_origin_m) / unit_m_),
                           static_cast<float>(frame.gap_y),
                           last_stride,
                           {},
                           spacing_of(frame)};
  for (int n = 0; n < frame.levels; ++n)
    selection_.mesh.morph.reach[n / 4][n % 4] =
        static_cast<float>(std::min(frame.reach[static_cast<std::size_t>(n)], 1e9));

  selection_.horizon_m =
      std::max(horizon_distance(eye.y, vertical_m, settings_.earth_curvature), 0.75 * frame.root_size * unit_m_);
  // The tree's centre may be half a spacing away from the viewer, and the grid point half a unit.
  const double off_centre_m =
      (static_cast<double>(spacing) + 1.0) * 0.5 * unit_m_ + glm::length(glm::dvec2(to_viewer)) * unit_m_;
  lay_skirt(frame, settings_.skirt_multiplier * (gpu::patch_quads << levels_) / frame.root_size,
            selection_.horizon_m + off_centre_m, selection_);

  selection_.visited_nodes = selection_.culled_nodes = selection_.skirt_strips = 0;
  frusta_.set(viewpoint.eyes, {selection_.grid_origin_m.x, 0.0, selection_.grid_origin_m.y});
  splits_.find(frame);
  find_leaves(frame, bounds);
  // By the threshold settings.cull_scale alone says what is left out.
  if (water.field != nullptr && water.tiles != nullptr && !viewpoint.eyes.empty() && by_pixels(settings_))
    cull_by_water_(*water.field, *water.tiles, frusta_, frame, selection_.grid_origin_m, runs_, leaves_);
  list_leaves(frame);
  skirt_.select(frame, splits_, frusta_, selection_);
  const int drop = settings_.drop_patch;
  if (drop >= 0 && drop < static_cast<int>(selection_.patches.size())) {
    if ((selection_.patches[static_cast<std::size_t>(drop)].flags & gpu::patch_skirt) != 0u) --selection_.skirt_strips;
    selection_.patches.erase(selection_.patches.begin() + drop);
  }
  if (water.gone && !settings_.freeze) leave_out(water);
  selected_ = true;
  return selection_;
}

void Quadtree::leave_out(const MeshWater& water) {
  const double about_m = water.bounds.horizontal_m * settings_.cull_scale + 0.01;
  const auto none = [&](const gpu::PatchInstance& patch) {
    if ((patch.flags & gpu::patch_skirt) != 0u) return false;
    const glm::dvec2 corner = selection_.grid_origin_m + glm::dvec2(patch.corner) * unit_m_;
    return water.gone(corner - about_m, corner + double(patch.stride * gpu::patch_quads) * unit_m_ + about_m);
  };
  selection_.culled_nodes += int(std::erase_if(selection_.patches, none));
}

// The spacing 2^n is left for its double at reach[n]. Masked joins take what the law says; morphed ones need the room
// that TreeFrame speaks of. If the sea does not move, nothing splits. The tree is the ocean's square, or a larger one
// of whole levels more: it reaches as far as motion is seen, or the skirt's multiplier says. For where the tree's
// centre moves on by a step, all of the skirt goes with it.
void Quadtree::find_reaches(const Reaches::Asked& asked) {
  const double pixels = asked.pixels_per_radian, vertical_m = asked.vertical_m;
  const MeshError& mesh_error = asked.mesh_error;
  const std::optional<NearMotion>& motion = asked.motion;
  const double ratio = spacing_over_distance(settings_);
  // The largest of N points of a normal sea is sqrt(2 ln N) deviations, and a picture that may err by as many pixels
  // has fewer of them, as the inverse square: of some million at one pixel, which is what mesh_error speaks of, a
  // seventh of the logarithm. Taken is a tenth: with a seventh one of 32 draws of 200 poses passed its pixels by 2 %,
  // and the largest of a draw scatters by 8 %.
  const double fewer = by_pixels(settings_) ? std::sqrt(1.0 - std::log(settings_.pixel_error) / 10.0) : 1.0;
  const bool morphed = settings_.join == LodJoin::morphed;
  const double early = morphed ? 1.0 : masked_early;
  // The reach of vertices `coarser_m` apart, of which a mesh misses `error_m`.
  const auto reach_of = [&](double coarser_m, double error_m) {
    if (by_pixels(settings_)) return early * fewer * error_m * pixels / settings_.pixel_error;
    return std::min(coarser_m / ratio, vertical_m / (error_over_spacing * ratio));
  };
  const double needed_m = std::min(reach_of(1e9, mesh_error.known() ? mesh_error.octave_m.back() : vertical_m),
                                   settings_.skirt_multiplier * settings_.ocean_size_m);
  int levels = levels_;
  for (double half_m = 0.5 * settings_.ocean_size_m; half_m < needed_m && levels < TreeFrame::max_levels; half_m *= 2.0)
    ++levels;
  const double root_m = (gpu::patch_quads << levels) * unit_m_;
  const auto error_m = [&](double spacing_m) {
    return mesh_error.known() ? mesh_error(spacing_m) : std::min(error_over_spacing * spacing_m, vertical_m);
  };
  near_reaches_.set(asked.near, asked.over_m);
  const auto reach_with_near = [&](double coarser_m) {
    return near_reaches_(coarser_m, error_m(coarser_m), [&](double missed_m) { return reach_of(coarser_m, missed_m); });
  };
  reaches_.known = true;
  reaches_.asked = asked;
  reaches_.near.assign(asked.near.begin(), asked.near.end());
  reaches_.asked.near = {};
  reaches_.levels = levels;
  reaches_.reach = {};
  reaches_.border_spacing = 1.0;
  double before = 0.0, most = 0.0;
  for (int n = 0; n < levels; ++n) {
    const double stride = 1 << n;
    double reach_m = reach_with_near(2.0 * stride * unit_m_);
    if (motion && reach_m > 0.0) reach_m += closer(reach_m, (*motion)(reach_m).y, fewer);
    most = std::max(most, reach_m / unit_m_);
    if (reach_m < 0.5 * root_m) reaches_.border_spacing = stride * std::clamp(root_m / reach_m, 2.0, 4.0);
    const double size = 2.0 * gpu::patch_quads * stride;
    double reach = std::max(reach_m / unit_m_, before);
    if (morphed) reach = std::max({reach, before + TreeFrame::morph_step * 0.5 * size, TreeFrame::morph_step * size});
    reaches_.reach[static_cast<std::size_t>(n)] = before = reach;
  }
  if (!(most > 0.0)) reaches_.reach.fill(0.0);
  reaches_.visible = std::max(most, 1.0);
}

// The leaves of a level are the quarters of the nodes split one level up that do not split themselves: in a row of them
// two runs, one to either side of the viewer's column. A level is culled as a whole: each plane cuts its rows where one
// sum says. Finer leaves, which are nearer, come first, and rows from the viewer's outwards: nearer water hides what
// follows. A leaf's bounds are its square grown by the displacement times cull_scale, and lowered by the sea's fall
// from the nearest of the level's leaves to the farthest.
void Quadtree::find_leaves(const TreeFrame& frame, const DisplacementBounds& bounds) {
  const std::size_t lists = frusta_.lists();
  leaves_.clear();
  std::size_t count = 0;
  int considered = 1;
  for (int level = splits_.levels() - 1; level >= 0; --level) {
    const SplitMap::Interval split_rows = splits_.rows(level);
    SplitMap::Interval split_columns{1 << level, -1};
    int nodes = 0;
    for (int z = split_rows.first; z <= split_rows.last; ++z) {
      const SplitMap::Interval row = splits_.row(level, z);
      if (row.last < row.first) continue;
      split_columns = {std::min(split_columns.first, row.first), std::max(split_columns.last, row.last)};
      nodes += row.last - row.first + 1;
    }
    if (nodes == 0) continue;
    considered += 3 * nodes;  // each node that splits is one leaf less and four more
    const BoxRange rows{2 * split_rows.first, 2 * split_rows.last + 1},
        columns{2 * split_columns.first, 2 * split_columns.last + 1};
    const int size = frame.size(level + 1), shift = std::countr_zero(static_cast<unsigned>(size));
    const double size_m = size * frame.unit_m;
    glm::dvec3 low(-frame.shift_m, -frame.rise_m, -frame.shift_m), high = -low;
    if (bounds.below) {
      const int row = frame.viewer_z >> (shift + 1);
      const double around_m = std::max({rows.last / 2 + 1 - row, row + 1 - rows.first / 2, 2}) * 2.0 * size_m;
      const glm::dvec2 off =
          near_deviations * bounds.below->motion(1.42 * around_m) + bounds.below->off(1.42 * around_m) + 0.01;
      const glm::dvec3 here = bounds.below->displacement_m, about(off.y, off.x, off.y);
      low = glm::max(low, glm::min(here - about, high));
      high = glm::min(high, glm::max(here + about, low));
    }
    const glm::dvec3 middle_m = 0.5 * (low + high), half_m = 0.5 * (high - low);
    const glm::dvec2 first_m =
        (glm::dvec2(frame.least) + 0.5 * size) * frame.unit_m + glm::dvec2(middle_m.x, middle_m.z);
    BoxGrid grid{first_m.x, first_m.y, size_m, 0.5 * size_m + half_m.x, 0.5 * size_m + half_m.z, low.y, high.y};
    if (frame.curved) {
      const auto away = [size_m](double first, double viewer, double half, BoxRange all) {
        const double from = first + all.first * size_m - viewer, to = first + all.last * size_m - viewer;
        return glm::dvec2(std::max({from - half, -to - half, 0.0}), std::max(std::abs(from), std::abs(to)) + half);
      };
      const glm::dvec2 x = away(grid.x, frame.viewer_m.x, grid.half_x, columns),
                       z = away(grid.z, frame.viewer_m.y, grid.half_z, rows);
      grid.high -= curvature_drop(x[0] * x[0] + z[0] * z[0]);
      grid.low -= curvature_drop(x[1] * x[1] + z[1] * z[1]);
    }
    frusta_.may_see(grid, rows, columns, seen_);
    const std::size_t first_run = count;
    const auto room = count + 2 * lists * static_cast<std::size_t>(rows.last - rows.first + 1) +
                      1;  // and one that is written in vain
    if (runs_.size() < room) runs_.resize(room + 64);
    const auto add_row = [&](int z) {
      BoxRange* const seen = &seen_[static_cast<std::size_t>(z - rows.first) * lists];
      const std::size_t ranges = lists == 2 ? join_two(seen) : join_ranges(seen, lists);
      if (ranges == 0) return;
      const SplitMap::Interval parents = splits_.row(level, z >> 1), split = splits_.row(level + 1, z);
      const int first = 2 * parents.first, last = 2 * parents.last + 1;
      const auto add = [&](int from, int to) {
        for (std::size_t n = 0; n < ranges; ++n) {
          const int run_first = std::max(from, seen[n].first), run_last = std::min(to, seen[n].last);
          runs_[count] = {z, run_first, run_last};
          count += run_first <= run_last ? 1u : 0u;
        }
      };
      if (split.last < split.first) return add(first, last);
      add(first, split.first - 1);
      add(split.last + 1, last);
    };
    const int middle = std::clamp(frame.viewer_z >> shift, rows.first, rows.last);
    add_row(middle);
    for (int off = 1; middle - off >= rows.first || middle + off <= rows.last; ++off) {
      if (middle + off <= rows.last) add_row(middle + off);
      if (middle - off >= rows.first) add_row(middle - off);
    }
    if (count > first_run)
      leaves_.push_back({level + 1, size, rows, columns, frame.viewer_x >> shift, first_run, count});
  }
  selection_.visited_nodes += considered;
  selection_.culled_nodes += considered;
}

void Quadtree::list_leaves(const TreeFrame& frame) {
  std::vector<gpu::PatchInstance>& patches = selection_.patches;
  std::size_t count = 0;
  for (const LeafLevel& leaves : leaves_) {
    const std::size_t before = count;
    write_leaves(leaves, std::span(runs_).subspan(leaves.first_run, leaves.end_run - leaves.first_run), frame.least,
                 static_cast<unsigned>(leaves.level) << gpu::patch_level_shift, patches, count);
    if (settings_.join != LodJoin::masked) continue;
    const int end = (1 << leaves.level) - 1;
    for (gpu::PatchInstance& patch : std::span(patches).subspan(before, count - before)) {
      const glm::ivec2 place = (patch.corner - frame.least) / leaves.size;
      patch.flags |= coarser_sides(leaves.level - 1, place.x, place.y, end);
    }
  }
  patches.resize(count);
  selection_.culled_nodes -= static_cast<int>(count);
}

// The edge bits of a leaf, a quarter of a node of `level`: the sides beyond which no node of that level splits. Outside
// the root none is coarser.
unsigned Quadtree::coarser_sides(int level, int x, int z, int end) const {
  const auto coarser = [&](int to_x, int to_z) {
    return to_x >= 0 && to_z >= 0 && to_x <= end && to_z <= end && !splits_.split(level, to_x >> 1, to_z >> 1);
  };
  return (coarser(x + 1, z) ? gpu::patch_east : 0u) | (coarser(x, z + 1) ? gpu::patch_north : 0u) |
         (coarser(x - 1, z) ? gpu::patch_west : 0u) | (coarser(x, z - 1) ? gpu::patch_south : 0u);
}

void Quadtree::move_frozen(std::int64_t grid_x, std::int64_t grid_z) {
  const std::int64_t dx = grid_x_ - grid_x, dz = grid_z_ - grid_z;
  constexpr std::int64_t most = std::int64_t{1} << 30;
  const std::int64_t x = selection_.mesh.tree_centre.x + dx, z = selection_.mesh.tree_centre.y + dz;
  if (x < -most || x > most || z < -most || z > most)
    throw Error("lod.freeze", "the viewer is more than 2^30 units away from where the patches were frozen",
                "set lod.freeze to false");
  const glm::ivec2 move(static_cast<int>(dx), static_cast<int>(dz));
  for (gpu::PatchInstance& patch : selection_.patches) patch.corner += move;
  selection_.mesh.tree_centre += move;
  selection_.mesh.morph.viewer += glm::vec2(move);
  grid_x_ = grid_x;
  grid_z_ = grid_z;
  selection_.grid_origin_m = glm::dvec2(static_cast<double>(grid_x), static_cast<double>(grid_z)) * unit_m_;
}

}  // namespace seascape
