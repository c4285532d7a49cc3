#include "ocean/mesh/skirt_strips.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>

#include "shaders/shared/skirt.h"

namespace seascape {
namespace {

glm::ivec2 on_side(int half, unsigned side, int along) {
  const int across = side < 2 ? half : -half;
  return side % 2 == 0 ? glm::ivec2(across, along - half) : glm::ivec2(along - half, across);
}

// Of the leaf at a place along a side, begun from that of another: neighbours differ by one level at most.
int leaf_level(const TreeFrame& frame, const SplitMap& splits, unsigned side, int along, int level) {
  const int shift = std::countr_zero(static_cast<unsigned>(frame.root_size));
  const auto split = [&](int at) {
    const int end = (1 << at) - 1, cell = along >> (shift - at);
    return splits.split(at, side == 0 ? end : side == 2 ? 0 : cell, side == 1 ? end : side == 3 ? 0 : cell);
  };
  while (level > 0 && !split(level - 1)) --level;
  while (level < frame.levels && split(level)) ++level;
  return level;
}

// The strips outside one side: the trapezoids that they cover, grown by the displacement times cull_scale, and lowered
// by the sea's fall from the nearest of a band to the farthest.
Border border_of(const TreeFrame& frame, const glm::ivec2& tree_centre, unsigned side) {
  const double half_m = 0.5 * frame.root_size * frame.unit_m;
  return {glm::dvec2(tree_centre) * frame.unit_m, side % 2 == 0 ? 1 : 0, side < 2 ? half_m : -half_m, half_m,
          frame.shift_m};
}
BorderBand band_of(const TreeFrame& frame, const Border& border, double inner, double outer) {
  BorderBand band{1.0 / inner, 1.0 / outer, -frame.rise_m, frame.rise_m};
  if (!frame.curved) return band;
  const glm::dvec2 off = border.centre - frame.viewer_m;
  const double nearest = std::max(std::abs(off[1 - border.axis] + border.border * inner) - border.grow, 0.0);
  const double reach = border.half * outer + 1.5 * border.grow, far_along = std::abs(off[border.axis]) + reach,
               far_across = std::abs(off[1 - border.axis]) + reach;
  band.low -= curvature_drop(far_along * far_along + far_across * far_across) * 1.000001;
  band.high -= curvature_drop(nearest * nearest);
  return band;
}

}  // namespace

// Dense as the patches only as far as the water's motion can be seen, rows as far apart as vertices may be at the
// border, of their distance; then sparser by skirt_growth. Both parts end at whole rows of their own spacing: from
// higher up more bands are laid outside of those that lie already, and none of these moves.
void lay_skirt(const TreeFrame& frame, double multiplier, double reach_m, SurfaceSelection& selection) {
  constexpr double growth = static_cast<double>(gpu::skirt_growth);
  const double half_m = 0.5 * frame.root_size * frame.unit_m;
  const double dense = std::clamp(frame.visible_reach * frame.unit_m / half_m, 1.0, std::max(multiplier, 1.0));
  const double near_growth = 1.0 + std::min(frame.border_spacing / (0.5 * frame.root_size), growth - 1.0);
  const int near_rows = static_cast<int>(std::ceil(std::log(dense) / std::log(near_growth)));
  const int far_rows =
      static_cast<int>(std::ceil(std::max(std::log(reach_m / half_m / dense) / std::log(growth), 0.0)));
  const int bands = std::clamp((near_rows + far_rows + gpu::patch_quads - 1) / gpu::patch_quads, 1,
                               static_cast<int>(SkirtStrips::most_bands));
  selection.mesh.skirt_rows = bands * gpu::patch_quads;
  selection.mesh.skirt_to_multiplier = static_cast<float>(dense);
  selection.mesh.skirt_to_horizon =
      static_cast<float>(dense * std::pow(growth, std::max(selection.mesh.skirt_rows - near_rows, 0)));
}

void SkirtStrips::find_rows(const SurfaceSelection& selection) {
  if (rows_ == selection.mesh.skirt_rows && to_multiplier_ == selection.mesh.skirt_to_multiplier &&
      to_horizon_ == selection.mesh.skirt_to_horizon)
    return;
  rows_ = selection.mesh.skirt_rows;
  to_multiplier_ = selection.mesh.skirt_to_multiplier;
  to_horizon_ = selection.mesh.skirt_to_horizon;
  const auto scale = [this](std::size_t band) {
    return static_cast<double>(
        gpu::skirt_scale(static_cast<int>(band) * gpu::patch_quads, rows_, to_multiplier_, to_horizon_));
  };
  const auto bands = static_cast<std::size_t>(rows_ / gpu::patch_quads);
  for (std::size_t band = 0; band < bands; ++band) of_band_[band] = {scale(band) * 0.999, scale(band + 1) * 1.001};
}

// Asked of a whole side first, then of all bands of it, and of no single strip: each plane cuts a band where one sum
// says.
void SkirtStrips::select(const TreeFrame& frame, const SplitMap& splits, const EyeFrusta& frusta,
                         SurfaceSelection& selection) {
  find_rows(selection);
  const auto bands = static_cast<std::size_t>(rows_ / gpu::patch_quads);
  const std::size_t lists = frusta.lists();
  const int half = selection.half_size;
  const double units = 1.0 / frame.unit_m;
  // More than is usual, and no cap: once as many were there, no frame allocates.
  seen_.reserve(4 * most_bands * lists);
  bands_.reserve(most_bands);
  for (std::vector<Leaf>& leaves : leaves_) leaves.reserve(512);
  seen_.resize(4 * bands * lists);
  bands_.resize(bands);
  for (unsigned side = 0; side < 4; ++side) {
    leaves_[side].clear();
    const Border border = border_of(frame, selection.mesh.tree_centre, side);
    const std::span<BorderRange> of_side = std::span(seen_).subspan(side * bands * lists, bands * lists);
    const BorderBand whole = band_of(frame, border, of_band_[0].inner, of_band_[bands - 1].outer);
    const auto each = [&]() -> std::span<const BorderBand> {
      for (std::size_t band = 0; band < bands; ++band)
        bands_[band] = band_of(frame, border, of_band_[band].inner, of_band_[band].outer);
      return bands_;
    };
    if (!frusta.may_see(border, whole, std::cref(each), of_side)) continue;
    const auto before = [](const BorderRange& a, const BorderRange& b) { return a.least < b.least; };
    for (auto of_band = of_side.begin(); lists > 1 && of_band != of_side.end();
         of_band += static_cast<std::ptrdiff_t>(lists))
      if (lists > 2)
        std::sort(of_band, of_band + static_cast<std::ptrdiff_t>(lists), before);
      else if (before(of_band[1], of_band[0]))
        std::swap(of_band[0], of_band[1]);
    // Of the side only what any band needs.
    double least = frame.root_size, most = 0.0;
    for (const BorderRange& range : of_side) {
      if (range.least > range.most) continue;
      least = std::min(least, range.least * units + half);
      most = std::max(most, range.most * units + half);
    }
    if (least > most) continue;
    int level = TreeFrame::least_levels;
    int along = std::clamp(static_cast<int>(std::floor(least)) - 1, 0, frame.root_size - 1);
    level = leaf_level(frame, splits, side, along, level);
    for (along &= -frame.size(level); along < frame.root_size && along <= most; along += frame.size(level)) {
      level = leaf_level(frame, splits, side, along, level);
      const int size = frame.size(level);
      const unsigned flags = gpu::patch_skirt | (side << gpu::patch_skirt_side_shift) |
                             (static_cast<unsigned>(level) << gpu::patch_level_shift);
      leaves_[side].push_back(
          {static_cast<double>(along),
           static_cast<double>(along + size),
           {selection.mesh.tree_centre + on_side(half, side, along), size / gpu::patch_quads, flags}});
    }
  }
  const std::size_t before = selection.patches.size();
  std::array<std::size_t, 4> first_leaf{};
  for (std::size_t band = 0; band < bands; ++band)
    for (unsigned side = 0; side < 4; ++side) {
      const unsigned flags = static_cast<unsigned>(band) << gpu::patch_skirt_band_shift;
      const std::vector<Leaf>& leaves = leaves_[side];
      if (leaves.empty()) continue;
      std::size_t& first = first_leaf[side];  // a band begins about where the one before did
      bool begun = false;
      std::size_t leaf = 0;
      for (const BorderRange& range : std::span(seen_).subspan((side * bands + band) * lists, lists)) {
        if (range.least > range.most) continue;
        // A strip that ends where the range begins may be seen too, and the last one where the side does.
        const double least = std::min(range.least * units + half, static_cast<double>(frame.root_size)),
                     most = range.most * units + half;
        if (!begun) {
          begun = true;
          while (first > 0 && (first == leaves.size() || leaves[first - 1].to >= least)) --first;
          while (first < leaves.size() && leaves[first].to < least) ++first;
          leaf = first;
        }
        while (leaf < leaves.size() && leaves[leaf].to < least) ++leaf;
        for (; leaf < leaves.size() && leaves[leaf].from <= most; ++leaf) {
          const gpu::PatchInstance& strip = leaves[leaf].strip;
          selection.patches.push_back({strip.corner, strip.stride, strip.flags | flags});
        }
      }
    }
  selection.skirt_strips += static_cast<int>(selection.patches.size() - before);
  selection.visited_nodes += selection.skirt_strips;
}

}  // namespace seascape
