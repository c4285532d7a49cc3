#include "ocean/lod/skirt_strips.h"

#include <array>
#include <cmath>

#include "shaders/shared/skirt.h"

namespace seascape {
namespace {

constexpr int most_bands = 63;

// What one call shares. A strip's bounds are the trapezoid that it covers, grown by the displacement times cull_scale.
struct Skirt {
  const TreeFrame& frame;
  const SplitMap& splits;
  const EyeFrusta& frusta;
  SurfaceSelection& selection;
  std::array<double, most_bands + 1> scale;  // of the first row of each band, and of the last row

  glm::ivec2 on_side(unsigned side, int t) const {
    const int half = selection.half_size, across = side < 2 ? half : -half;
    return side % 2 == 0 ? glm::ivec2(across, t - half) : glm::ivec2(t - half, across);
  }

  // Of the part of the skirt outside `first` to `second` along a side, from one band's first row to another's.
  UprightPrism bounds_of(unsigned side, int first, int second, unsigned band, unsigned end) const {
    const double unit_m = frame.unit_m, inner = scale[band] * 0.999, outer = scale[end] * 1.001;
    const glm::dvec2 centre(selection.tree_centre), a(on_side(side, first)), b(on_side(side, second));
    UprightPrism prism{{(centre + a * inner) * unit_m, (centre + b * inner) * unit_m, (centre + a * outer) * unit_m, (centre + b * outer) * unit_m},
                       frame.shift_m, -frame.rise_m, frame.rise_m};
    if (frame.curved) {
      double farthest2 = 0.0;
      for (const glm::dvec2& corner : prism.corners) {
        const glm::dvec2 away = corner - frame.viewer_m;
        farthest2 = std::max(farthest2, glm::dot(away, away));
      }
      const double farthest = std::sqrt(farthest2) + 1.5 * prism.grow;
      prism.low -= curvature_drop(farthest * farthest) * 1.000001;
      const glm::dvec2 to_side = glm::abs(prism.corners[0] - frame.viewer_m);
      const double nearest = std::max((side % 2 == 0 ? to_side.x : to_side.y) - prism.grow, 0.0);
      prism.high -= curvature_drop(nearest * nearest);
    }
    return prism;
  }

  int leaf_level(unsigned side, int along) const {
    int level = 0;
    for (; level < frame.levels; ++level) {
      const int end = (1 << level) - 1, cell = along / frame.size(level);
      const int x = side == 0 ? end : side == 2 ? 0 : cell, z = side == 1 ? end : side == 3 ? 0 : cell;
      if (!splits.split(level, x, z)) break;
    }
    return level;
  }
};

}  // namespace

// Dense as the patches only as far as the water's motion can be seen, rows as far apart as vertices may be at the border, of their distance;
// then sparser by skirt_growth. Both parts end at whole rows of their own spacing: from higher up more bands are laid outside of
// those that lie already, and none of these moves.
void lay_skirt(const TreeFrame& frame, double multiplier, double reach_m, SurfaceSelection& selection) {
  constexpr double growth = static_cast<double>(gpu::skirt_growth);
  const double half_m = 0.5 * frame.root_size * frame.unit_m;
  const double dense = std::clamp(frame.visible_reach * frame.unit_m / half_m, 1.0, multiplier);
  const double near_growth = 1.0 + std::min(frame.border_spacing / (0.5 * frame.root_size), growth - 1.0);
  const int near_rows = static_cast<int>(std::ceil(std::log(dense) / std::log(near_growth)));
  const int far_rows = static_cast<int>(std::ceil(std::max(std::log(reach_m / half_m / dense) / std::log(growth), 0.0)));
  const int bands = std::clamp((near_rows + far_rows + gpu::patch_quads - 1) / gpu::patch_quads, 1, most_bands);
  selection.skirt_rows = bands * gpu::patch_quads;
  selection.skirt_to_multiplier = static_cast<float>(dense);
  selection.skirt_to_horizon = static_cast<float>(dense * std::pow(growth, std::max(selection.skirt_rows - near_rows, 0)));
}

// Asked of a whole side first, then of each band of it, and of the strips only where that is neither wholly seen nor unseen.
void select_skirt(const TreeFrame& frame, const SplitMap& splits, const EyeFrusta& frusta, SurfaceSelection& selection) {
  Skirt skirt{frame, splits, frusta, selection, {}};
  const auto bands = static_cast<unsigned>(selection.skirt_rows / gpu::patch_quads);
  for (unsigned band = 0; band <= bands; ++band)
    skirt.scale[band] = static_cast<double>(gpu::skirt_scale(static_cast<int>(band) * gpu::patch_quads, selection.skirt_rows,
                                                             selection.skirt_to_multiplier, selection.skirt_to_horizon));
  const auto may_see = [&](unsigned side, int first, int second, unsigned band, unsigned end, EyeFrusta::Questions& questions) {
    if (questions == EyeFrusta::none) return true;
    ++selection.visited_nodes;
    if (frusta.may_see(skirt.bounds_of(side, first, second, band, end), questions)) return true;
    ++selection.culled_nodes;
    return false;
  };
  std::array<EyeFrusta::Questions, 4> of_side;
  std::array<bool, 4> seen;
  for (unsigned side = 0; side < 4; ++side) {
    of_side[side] = frusta.all();
    seen[side] = may_see(side, 0, frame.root_size, 0, bands, of_side[side]);
  }
  for (unsigned band = 0; band < bands; ++band)
    for (unsigned side = 0; side < 4; ++side) {
      if (!seen[side]) continue;
      EyeFrusta::Questions of_band = of_side[side];
      if (!may_see(side, 0, frame.root_size, band, band + 1, of_band)) continue;
      for (int along = 0; along < frame.root_size;) {
        const int level = skirt.leaf_level(side, along), size = frame.size(level), first = along;
        along += size;
        EyeFrusta::Questions questions = of_band;
        if (!may_see(side, first, along, band, band + 1, questions)) continue;
        ++selection.skirt_strips;
        selection.patches.push_back({selection.tree_centre + skirt.on_side(side, first), size / gpu::patch_quads,
                                     gpu::patch_skirt | (side << gpu::patch_skirt_side_shift) | (band << gpu::patch_skirt_band_shift) |
                                         (static_cast<unsigned>(level) << gpu::patch_level_shift)});
      }
    }
}

}  // namespace seascape
