// A gloved hand as a list of rounded limbs, opened or closed. Pure.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "engine/view.h"

namespace seascape {

// A tapered capsule from one end to the other.
struct Limb {
  glm::dvec3 from_m, to_m;
  double from_radius_m, to_radius_m;
  glm::vec3 colour;  // reflectance; of what glows how it looks, whatever the light
  bool glows = false;
};

inline constexpr std::size_t most_limbs = 24;  // of a hand

// Appends a hand's limbs. At `pose` is the middle of the palm; -z is where the open fingers point, +y where the thumb
// is, and the palm looks towards the other hand. `closed`: 0 open to 1 a fist.
void append_hand(const Pose& pose, bool right, double closed, std::vector<Limb>& limbs);

}  // namespace seascape
