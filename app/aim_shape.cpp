#include "app/aim_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace seascape {

namespace {

constexpr glm::vec3 amber{1.0f, 0.42f, 0.03f}, red{0.9f, 0.02f, 0.02f};
constexpr double line_m = 0.004, ring_m = 0.025;  // radii up close
constexpr double radians = 0.0026;                // and half the width that they are seen in, at least
constexpr double before_hand_m = 0.12;            // the line begins there: no fingers are in it

}  // namespace

glm::dvec2 aim_corner(const glm::dvec3& at_m, std::size_t corner) {
  const double about = glm::two_pi<double>() * double(corner) / double(ShownAim::sides);
  return glm::dvec2(at_m.x, at_m.z) + aim_ring_m * glm::dvec2(std::cos(about), std::sin(about));
}

void append_aim(const ShownAim& aim, const glm::dvec3& viewer_m, std::vector<Limb>& limbs) {
  const auto radius = [&](const glm::dvec3& at, double least_m) {
    return std::max(least_m, radians * glm::distance(at, viewer_m));
  };
  const glm::vec3& colour = aim.found ? amber : red;
  if (aim.from_m && glm::distance(*aim.from_m, aim.to_m) > before_hand_m) {
    const glm::dvec3 from = *aim.from_m + before_hand_m * glm::normalize(aim.to_m - *aim.from_m);
    limbs.push_back({from, aim.to_m, radius(from, line_m), radius(aim.to_m, line_m), colour, true});
  }
  if (!aim.found) return;
  std::array<glm::dvec3, ShownAim::sides> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 place = aim_corner(aim.to_m, i);
    corners[i] = {place.x, aim.water_m[i], place.y};
    corners[i].y += radius(corners[i], ring_m);  // it lies on the water
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &from = corners[i], &to = corners[(i + 1) % corners.size()];
    limbs.push_back({from, to, radius(from, ring_m), radius(to, ring_m), colour, true});
  }
}

}  // namespace seascape
