// How a swimmer is driven: hands that pull back through the water push him ahead, and the water slows him. Pure.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace seascape {

// A hand as it moves, without what moves the swimmer himself.
struct SwimHand {
  glm::dvec3 velocity_mps{0.0};  // in the world's axes, against the head
  double under_water = 0.0;      // share of it, 0 to 1
};

struct SwimWish {
  glm::dvec3 ahead{0.0, 0.0, -1.0};              // where he looks, along the sea or under water; of length 1
  std::array<std::optional<SwimHand>, 2> hands;  // of those that are tracked
  bool tracked = false;                          // hands pull, or else he goes ahead by himself
};

// Forces go as the square of speeds through the water, F = rho / 2 c A v^2. Of a hand with its forearm c A is 0.044
// m^2; a swimmer's drag is 25 kg/m v^2 (Toussaint et al. 1988: 19 to 30), his mass with the water that goes along 90
// kg. A hand pushes only as it moves back, as seen from the head: brought ahead it is turned edgewise.
class Swim {
 public:
  static constexpr double mass_kg = 90.0, drag_kg_m = 25.0, hand_kg_m = 22.0;
  static constexpr double own_speed_mps = 1.0;     // without hands
  static constexpr double fastest_hand_mps = 6.0;  // what is faster is a tracker that jumped, and pushes not at all

  // Goes on for `dt_s` with the same wish. Stable for any time: each short step follows the linear equation that
  // touches the true one, exactly (an exponential Euler step, of second order). What is not a number counts as nothing.
  void step(const SwimWish& wish, double dt_s);
  // Out of the water; or in it again, with a velocity.
  void begin_anew(const glm::dvec3& velocity_mps = glm::dvec3(0.0));

  const glm::dvec3& velocity_mps() const { return velocity_mps_; }
  const glm::dvec3& moved_m() const { return moved_m_; }  // in the last step

 private:
  void pull(const SwimWish& wish, double dt_s);
  glm::dvec3 velocity_mps_{0.0}, moved_m_{0.0};
};

}  // namespace seascape
