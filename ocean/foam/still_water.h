// The still water at a place, as foam asks for it.
#pragma once
#include <functional>
#include <glm/glm.hpp>

namespace seascape {

// How deep it is (m; 0 or less is land), how much of the waves' height it leaves, and how much of their energy breaks
// there; the same two of waves that run along curves.
struct StillWater {
  double depth_m = 1e6, waves = 1.0, surf = 0.0;
  double placed = 1.0, placed_surf = 0.0;
};

// Of a texel at a rest position (m), for its side (m). Asked by several threads at once; null: the open sea.
using StillWaterAt = std::function<StillWater(glm::dvec2 rest_m, double texel_m)>;

}  // namespace seascape
