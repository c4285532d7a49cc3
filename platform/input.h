// What a person did since the last frame, as actions; where his hands are.
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/view.h"
#include "platform/actions.h"

namespace seascape {

// A hand as it is tracked, in metres from the middle of the floor on which one stands (x, y up, -z forward).
struct Hand {
  Pose grip;  // in the closed hand: -z along the thumb's side of a fist held forward, as OpenXR's grip
  Pose aim;   // points along -z
  glm::dvec3 velocity_mps{0.0};  // of the grip
};

struct Press {
  Action action;
  double value;  // 1, or -1 of an axis
};

struct Input {
  std::array<double, action_count> values{};  // now, within what ActionRow says
  std::vector<Press> pressed;                 // what came to be asked for, in order, repeats excepted
  std::array<std::optional<Hand>, 2> hands;   // left, right; nothing of one that is not tracked
  glm::dvec2 mouse_pixels{0.0};               // how far the mouse moved, x to the right, y down
  double wheel = 0.0;                         // notches, away from the hand positive
  bool right_button = false;                  // down now

  double value(Action action) const { return values[std::size_t(action)]; }
  bool held(Action action) const { return std::abs(value(action)) >= 0.5; }
};

// What two of them ask for together: values add up within an action's range, presses follow each other, what both ask
// for counts once. Hands are of the first that has them.
Input joined(const Input& a, const Input& b);

// Makes each frame's Input of what devices say. What was held when it was reset does not count until it is let go.
class InputGatherer {
 public:
  // A key went down: it counts even when it is up again before the frame begins.
  void press(Action action, double value) { presses_.push_back({action, value}); }
  // Adds to an action's value in the frame that is being gathered; several devices add up.
  void add(Action action, double value) { values_[std::size_t(action)] += value; }
  // The frame's actions. What add() brought over half its way counts as pressed too, once until it falls below a third.
  Input take();
  // Nothing is asked for any more: the focus went.
  void reset();

 private:
  std::vector<Press> presses_;
  std::array<double, action_count> values_{};
  std::array<signed char, action_count> down_{};  // -1, 0, 1
  std::array<bool, action_count> stale_{};        // held since the reset
};

}  // namespace seascape
