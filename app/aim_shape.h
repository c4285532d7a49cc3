// Where a teleport aims, to be seen: a line from the hand, and a ring that rides on the water. Pure.
#pragma once
#include <array>
#include <optional>

#include "app/hand_shape.h"

namespace seascape {

struct ShownAim {
  static constexpr std::size_t sides = 32;
  std::optional<glm::dvec3> from_m;   // where the line begins; nothing: one aims with the head
  glm::dvec3 to_m{0.0};               // the water that is aimed at; with none in reach a place on the way there
  bool found = false;                 // water: without it there is no ring, and the line is red
  std::array<double, sides> water_m;  // the sea's height at the ring's corners
};

inline constexpr double aim_ring_m = 0.6;  // the ring's radius
inline constexpr double aim_line_without_water_m = 6.0;
inline constexpr std::size_t most_aim_limbs = ShownAim::sides + 1;

// The x and z of a corner of the ring about a place.
glm::dvec2 aim_corner(const glm::dvec3& at_m, std::size_t corner);

// Appends its limbs. They grow with the distance from the eyes, so that what is far away is still a pixel wide.
void append_aim(const ShownAim& aim, const glm::dvec3& viewer_m, std::vector<Limb>& limbs);

}  // namespace seascape
