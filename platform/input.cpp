#include "platform/input.h"

#include <algorithm>
#include <utility>

namespace seascape {

Input joined(const Input& a, const Input& b) {
  Input both = a;
  for (const ActionRow& row : action_rows()) {
    double& value = both.values[std::size_t(row.action)];
    value = std::clamp(value + b.value(row.action), row.least(), 1.0);
  }
  for (const Press& press : b.pressed) {
    const bool told = std::any_of(a.pressed.begin(), a.pressed.end(), [&](const Press& other) {
      return other.action == press.action && other.value == press.value;
    });
    if (!told) both.pressed.push_back(press);
  }
  for (std::size_t hand = 0; hand < both.hands.size(); ++hand)
    if (!both.hands[hand]) both.hands[hand] = b.hands[hand];
  both.mouse_pixels += b.mouse_pixels;
  both.wheel += b.wheel;
  both.right_button = a.right_button || b.right_button;
  return both;
}

Input InputGatherer::take() {
  constexpr double pressed_at = 0.5, free_at = 1.0 / 3.0;
  Input input;
  input.pressed = std::exchange(presses_, {});
  for (const ActionRow& row : action_rows()) {
    const std::size_t i = std::size_t(row.action);
    double value = std::clamp(std::exchange(values_[i], 0.0), row.least(), 1.0);
    if (!(value == value)) value = 0.0;
    if (stale_[i] && std::abs(value) >= free_at)
      value = 0.0;
    else
      stale_[i] = false;
    input.values[i] = value;
    const signed char side = value < 0.0 ? -1 : 1;
    if (std::abs(value) >= pressed_at && down_[i] != side) {
      down_[i] = side;
      const bool told = std::any_of(input.pressed.begin(), input.pressed.end(), [&](const Press& press) {
        return press.action == row.action && (press.value < 0.0) == (value < 0.0);
      });
      if (!told) input.pressed.push_back({row.action, double(side)});
    } else if (std::abs(value) < free_at || down_[i] != side) {
      down_[i] = 0;
    }
  }
  return input;
}

void InputGatherer::reset() {
  presses_.clear();
  values_ = {};
  down_ = {};
  stale_.fill(true);
}

}  // namespace seascape
