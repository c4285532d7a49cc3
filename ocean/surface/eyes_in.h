// Where the eyes of a frame are.
#pragma once
#include <cmath>

#include "engine/view.h"
#include "shaders/shared/frame_data.h"

namespace seascape {

enum class EyesIn {
  air = gpu::eyes_in_air,        // all of them, with all that their near planes reach
  either = gpu::eyes_in_either,  // so near the surface that each pixel has to be asked
  water = gpu::eyes_in_water     // all of them, and nothing of the air before them
};

// Where the water rests that may pass an eye's near plane: in a rectangle of the world's x and z.
struct NearWater {
  glm::dvec2 rest_m{0.0};       // its middle
  glm::dvec2 across{1.0, 0.0};  // of unit length: along its first side
  glm::dvec2 half_m{0.0};       // half of that side, and of the one at right angles to it
  // Whether an upright rectangle of corners `least` and `most` touches it (separating axes: Gottschalk et al. 1996).
  bool touches(const glm::dvec2& least, const glm::dvec2& most) const {
    const glm::dvec2 off = 0.5 * (least + most) - rest_m, half = 0.5 * (most - least), turned = glm::abs(across);
    return std::abs(off.x) <= half.x + turned.x * half_m.x + turned.y * half_m.y &&
           std::abs(off.y) <= half.y + turned.y * half_m.x + turned.x * half_m.y &&
           std::abs(glm::dot(off, across)) <= half_m.x + glm::dot(half, turned) &&
           std::abs(across.x * off.y - across.y * off.x) <= half_m.y + half.x * turned.y + half.y * turned.x;
  }
};

// Of the near plane of an eye, `near_m` before it, whose corners are `reach_m` from the eye; `over`: how high the water
// is over the eye, metres, and its slopes along x and z there; `unsure_m`: by how much that may be off. The rectangle
// is about (0, 0), where the water over the eye rests.
NearWater near_water(const View& eye, double near_m, double reach_m, const glm::dvec3& over, double unsure_m);

}  // namespace seascape
