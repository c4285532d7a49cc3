#include "app/hand_shape.h"

#include <algorithm>
#include <array>

namespace seascape {

namespace {

constexpr glm::vec3 glove{0.32f, 0.33f, 0.35f}, cuff{0.62f, 0.20f, 0.04f};

// Of a grown person's hand, in metres: where each finger's knuckle lies, and how long its three bones are.
struct Finger {
  double knuckle_y, knuckle_z;
  std::array<double, 3> bones;
  double radius;
};
constexpr Finger fingers[] = {{0.034, -0.046, {0.042, 0.026, 0.020}, 0.0095},
                              {0.012, -0.050, {0.046, 0.029, 0.021}, 0.0098},
                              {-0.010, -0.047, {0.042, 0.027, 0.020}, 0.0092},
                              {-0.031, -0.039, {0.033, 0.020, 0.018}, 0.0082}};

}  // namespace

void append_hand(const Pose& pose, bool right, double closed, std::vector<Limb>& limbs) {
  closed = std::clamp(closed, 0.0, 1.0);
  const double side = right ? 1.0 : -1.0;  // towards the back of the hand; what is written here is a right one
  const auto place = [&](const glm::dvec3& at) {
    return pose.position_m + pose.orientation * glm::dvec3(side * at.x, at.y, at.z);
  };
  const auto add = [&](const glm::dvec3& from, const glm::dvec3& to, double from_radius, double to_radius,
                       const glm::vec3& colour = glove) {
    limbs.push_back({place(from), place(to), from_radius, to_radius, colour});
  };
  add({0.002, 0.002, 0.060}, {0.004, 0.0, 0.140}, 0.027, 0.031, cuff);
  // Joints bend about the hand's y, towards the palm at -x: from nearly straight to a fist.
  const std::array<double, 3> open{8.0, 12.0, 8.0}, fist{72.0, 95.0, 55.0};
  for (const Finger& finger : fingers) {
    glm::dvec3 at(0.0, finger.knuckle_y, finger.knuckle_z);
    add({0.002, 0.62 * finger.knuckle_y, 0.050}, at, 0.0165, 0.0125);
    double bend_deg = 0.0;
    for (std::size_t bone = 0; bone < 3; ++bone) {
      bend_deg += open[bone] + (fist[bone] - open[bone]) * closed;
      const double bend = glm::radians(bend_deg), taper = 1.0 - 0.07 * double(bone);
      const glm::dvec3 next = at + finger.bones[bone] * glm::dvec3(-std::sin(bend), 0.0, -std::cos(bend));
      add(at, next, finger.radius * taper, finger.radius * (taper - 0.07));
      at = next;
    }
  }
  // The thumb lies over a fist's fingers, and beside an open hand.
  const auto thumb = [&](const glm::dvec3& opened, const glm::dvec3& fisted) {
    return glm::mix(opened, fisted, closed);
  };
  const glm::dvec3 root(-0.006, 0.022, 0.036), first = thumb({-0.016, 0.052, 0.006}, {-0.030, 0.040, -0.004}),
                                               second = thumb({-0.022, 0.066, -0.028}, {-0.044, 0.026, -0.032}),
                                               tip = thumb({-0.026, 0.070, -0.054}, {-0.046, 0.002, -0.044});
  add(root, first, 0.0165, 0.0135);
  add(first, second, 0.0125, 0.0108);
  add(second, tip, 0.0108, 0.0092);
}

}  // namespace seascape
