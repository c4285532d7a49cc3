#include "ocean/lod/skirt_strips.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "shaders/shared/skirt.h"

namespace seascape {
namespace {

constexpr int most_bands = 63;

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

// The strips outside one side: the trapezoids that they cover, grown by the displacement times cull_scale, and lowered by the sea's fall from
// the nearest of a band to the farthest.
Border border_of(const TreeFrame& frame, const glm::ivec2& tree_centre, unsigned side) {
  const double half_m = 0.5 * frame.root_size * frame.unit_m;
  return {glm::dvec2(tree_centre) * frame.unit_m, side % 2 == 0 ? 1 : 0, side < 2 ? half_m : -half_m, half_m, frame.shift_m};
}
BorderBand band_of(const TreeFrame& frame, const Border& border, double first_scale, double last_scale) {
  const double inner = first_scale * 0.999, outer = last_scale * 1.001;
  BorderBand band{1.0 / inner, 1.0 / outer, -frame.rise_m, frame.rise_m};
  if (!frame.curved) return band;
  const glm::dvec2 off = border.centre - frame.viewer_m;
  const double nearest = std::max(std::abs(off[1 - border.axis] + border.border * inner) - border.grow, 0.0);
  const double reach = border.half * outer + 1.5 * border.grow, far_along = std::abs(off[border.axis]) + reach, far_across = std::abs(off[1 - border.axis]) + reach;
  band.low -= curvature_drop(far_along * far_along + far_across * far_across) * 1.000001;
  band.high -= curvature_drop(nearest * nearest);
  return band;
}

}  // namespace

// Dense as the patches only as far as the water's motion can be seen, rows as far apart as vertices may be at the border, of their distance;
// then sparser by skirt_growth. Both parts end at whole rows of their own spacing: from higher up more bands are laid outside of
// those that lie already, and none of these moves.
void lay_skirt(const TreeFrame& frame, double multiplier, double reach_m, SurfaceSelection& selection) {
  constexpr double growth = static_cast<double>(gpu::skirt_growth);
  const double half_m = 0.5 * frame.root_size * frame.unit_m;
  const double dense = std::clamp(frame.visible_reach * frame.unit_m / half_m, 1.0, std::max(multiplier, 1.0));
  const double near_growth = 1.0 + std::min(frame.border_spacing / (0.5 * frame.root_size), growth - 1.0);
  const int near_rows = static_cast<int>(std::ceil(std::log(dense) / std::log(near_growth)));
  const int far_rows = static_cast<int>(std::ceil(std::max(std::log(reach_m / half_m / dense) / std::log(growth), 0.0)));
  const int bands = std::clamp((near_rows + far_rows + gpu::patch_quads - 1) / gpu::patch_quads, 1, most_bands);
  selection.skirt_rows = bands * gpu::patch_quads;
  selection.skirt_to_multiplier = static_cast<float>(dense);
  selection.skirt_to_horizon = static_cast<float>(dense * std::pow(growth, std::max(selection.skirt_rows - near_rows, 0)));
}

// Asked of a whole side first, then of all bands of it, and of no single strip: each plane cuts a band where one sum says.
void select_skirt(const TreeFrame& frame, const SplitMap& splits, const EyeFrusta& frusta, std::vector<BorderRange>& seen, SurfaceSelection& selection) {
  const auto bands = static_cast<std::size_t>(selection.skirt_rows / gpu::patch_quads);
  std::array<double, most_bands + 1> scale;  // of the first row of each band, and of the last row
  for (std::size_t band = 0; band <= bands; ++band)
    scale[band] = static_cast<double>(gpu::skirt_scale(static_cast<int>(band) * gpu::patch_quads, selection.skirt_rows,
                                                       selection.skirt_to_multiplier, selection.skirt_to_horizon));
  const std::size_t lists = frusta.lists();
  seen.resize(4 * bands * lists);
  std::array<bool, 4> sides;
  for (unsigned side = 0; side < 4; ++side) {
    const Border border = border_of(frame, selection.tree_centre, side);
    const std::span<BorderRange> of_side = std::span(seen).subspan(side * bands * lists, bands * lists);
    const BorderBand whole = band_of(frame, border, scale[0], scale[bands]);
    frusta.may_see(border, std::span(&whole, 1), of_side.first(lists));
    sides[side] = std::any_of(of_side.begin(), of_side.begin() + static_cast<std::ptrdiff_t>(lists), [](const BorderRange& r) { return r.least <= r.most; });
    if (!sides[side]) continue;
    std::array<BorderBand, most_bands> each;
    for (std::size_t band = 0; band < bands; ++band) each[band] = band_of(frame, border, scale[band], scale[band + 1]);
    frusta.may_see(border, std::span(each).first(bands), of_side);
    for (std::size_t band = 0; lists > 1 && band < bands; ++band)
      std::sort(&of_side[band * lists], &of_side[band * lists] + lists, [](const BorderRange& a, const BorderRange& b) { return a.least < b.least; });
  }
  const int half = selection.half_size;
  const double units = 1.0 / frame.unit_m, last = static_cast<double>(frame.root_size - 1);
  for (std::size_t band = 0; band < bands; ++band)
    for (unsigned side = 0; side < 4; ++side) {
      if (!sides[side]) continue;
      int listed = 0, level = TreeFrame::least_levels;  // along the side, up to here
      for (const BorderRange& range : std::span(seen).subspan((side * bands + band) * lists, lists)) {
        if (range.least > range.most) continue;
        // A strip that ends where the range begins may be seen too.
        const auto first = static_cast<int>(std::clamp(std::ceil(range.least * units + half) - 1.0, 0.0, last));
        const double most = range.most * units + half;
        for (int along = std::max(first, listed); along < frame.root_size && along <= most;) {
          level = leaf_level(frame, splits, side, along, level);
          const int size = frame.size(level);
          along &= -size;
          ++selection.skirt_strips;
          selection.patches.push_back({selection.tree_centre + on_side(half, side, along), size / gpu::patch_quads,
                                       gpu::patch_skirt | (side << gpu::patch_skirt_side_shift) | (static_cast<unsigned>(band) << gpu::patch_skirt_band_shift) |
                                           (static_cast<unsigned>(level) << gpu::patch_level_shift)});
          listed = along += size;
        }
      }
    }
  selection.visited_nodes += selection.skirt_strips;
}

}  // namespace seascape
