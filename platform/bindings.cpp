#include "platform/bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {

using enum Action;
using enum Post;

constexpr KeyBinding keys[] = {
    {GLFW_KEY_D, move_x, 1.0, afoot},
    {GLFW_KEY_A, move_x, -1.0, afoot},
    {GLFW_KEY_S, move_z, 1.0, afoot},
    {GLFW_KEY_W, move_z, -1.0, afoot},
    {GLFW_KEY_E, move_y, 1.0, afoot},
    {GLFW_KEY_Q, move_y, -1.0, afoot},
    {GLFW_KEY_D, helm, 1.0, aboard},
    {GLFW_KEY_A, helm, -1.0, aboard},
    {GLFW_KEY_W, throttle, 1.0, aboard},
    {GLFW_KEY_S, throttle, -1.0, aboard},
    {GLFW_KEY_E, sheet, 1.0, aboard},
    {GLFW_KEY_J, oar_left, 1.0, aboard},
    {GLFW_KEY_U, oar_left, -1.0, aboard},
    {GLFW_KEY_L, oar_right, 1.0, aboard},
    {GLFW_KEY_O, oar_right, -1.0, aboard},
    {GLFW_KEY_Y, moor, 1.0, aboard},
    {GLFW_KEY_I, anchor, 1.0, aboard},
    {GLFW_KEY_BACKSPACE, respawn},
    {GLFW_KEY_RIGHT, turn, 1.0},
    {GLFW_KEY_LEFT, turn, -1.0},
    {GLFW_KEY_UP, pitch, 1.0},
    {GLFW_KEY_DOWN, pitch, -1.0},
    {GLFW_KEY_X, snap_turn, 1.0},
    {GLFW_KEY_Z, snap_turn, -1.0},
    {GLFW_KEY_T, teleport},
    {GLFW_KEY_F, swim},
    {GLFW_KEY_G, grab_left},
    {GLFW_KEY_H, grab_right},
    {GLFW_KEY_COMMA, scrub, -1.0},
    {GLFW_KEY_PERIOD, scrub, 1.0},
    {GLFW_KEY_LEFT_BRACKET, time_scale, -1.0},
    {GLFW_KEY_RIGHT_BRACKET, time_scale, 1.0},
    {GLFW_KEY_B, board},
    {GLFW_KEY_F1, menu},
    {GLFW_KEY_C, recentre},
    {GLFW_KEY_N, light},
    {GLFW_KEY_M, mirror},
    {GLFW_KEY_P, screenshot},
    {GLFW_KEY_F2, screenshot},
    {GLFW_KEY_R, record},
    {GLFW_KEY_LEFT_SHIFT, fast},
    {GLFW_KEY_RIGHT_SHIFT, fast},
    {GLFW_KEY_TAB, look},
    {GLFW_KEY_1, fly},
    {GLFW_KEY_2, walk},
    {GLFW_KEY_3, ride},
    {GLFW_KEY_SPACE, pause},
    {GLFW_KEY_V, debug_view},
    {GLFW_KEY_K, comfort},
    {GLFW_KEY_ESCAPE, leave},
};

constexpr auto button = GamepadBinding::Part::button;
constexpr auto stick = GamepadBinding::Part::stick;
constexpr auto trigger = GamepadBinding::Part::trigger;

// Sticks point down at their positive ends, as z does back.
constexpr GamepadBinding gamepad[] = {
    {stick, GLFW_GAMEPAD_AXIS_LEFT_X, move_x, 1.0, afoot},
    {stick, GLFW_GAMEPAD_AXIS_LEFT_Y, move_z, 1.0, afoot},
    {stick, GLFW_GAMEPAD_AXIS_RIGHT_X, turn, 1.0},
    {stick, GLFW_GAMEPAD_AXIS_RIGHT_Y, pitch, -1.0, afoot},
    {trigger, GLFW_GAMEPAD_AXIS_LEFT_TRIGGER, grab_left, 1.0, afoot},
    {trigger, GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER, grab_right, 1.0, afoot},
    {button, GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, snap_turn, -1.0, afoot},
    {button, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, snap_turn, 1.0, afoot},
    {button, GLFW_GAMEPAD_BUTTON_DPAD_UP, move_y, 1.0, afoot},
    {button, GLFW_GAMEPAD_BUTTON_DPAD_DOWN, move_y, -1.0, afoot},
    {stick, GLFW_GAMEPAD_AXIS_LEFT_X, helm, 1.0, aboard},
    {trigger, GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER, throttle, 1.0, aboard},
    {trigger, GLFW_GAMEPAD_AXIS_LEFT_TRIGGER, throttle, -1.0, aboard},
    {stick, GLFW_GAMEPAD_AXIS_RIGHT_Y, sheet, 1.0, aboard},
    {button, GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, oar_left, 1.0, aboard},
    {button, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER, oar_right, 1.0, aboard},
    {button, GLFW_GAMEPAD_BUTTON_DPAD_UP, moor, 1.0, aboard},
    {button, GLFW_GAMEPAD_BUTTON_DPAD_DOWN, anchor, 1.0, aboard},
    {button, GLFW_GAMEPAD_BUTTON_A, swim},
    {button, GLFW_GAMEPAD_BUTTON_B, teleport},
    {button, GLFW_GAMEPAD_BUTTON_X, board},
    {button, GLFW_GAMEPAD_BUTTON_Y, light},
    {button, GLFW_GAMEPAD_BUTTON_LEFT_THUMB, fast},
    {button, GLFW_GAMEPAD_BUTTON_RIGHT_THUMB, recentre},
    {button, GLFW_GAMEPAD_BUTTON_START, menu},
    {button, GLFW_GAMEPAD_BUTTON_BACK, mirror},
    {button, GLFW_GAMEPAD_BUTTON_DPAD_LEFT, record},
    {button, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT, screenshot},
};

// Thumbsticks and trackpads point away from the body at their positive ends.
constexpr ControllerBinding touch[] = {
    {"left/input/thumbstick/x", move_x, 1.0, afoot},
    {"left/input/thumbstick/y", move_z, -1.0, afoot},
    {"right/input/thumbstick/x", turn},
    {"right/input/thumbstick/x", snap_turn},
    {"right/input/thumbstick/y", move_y, 1.0, afoot},
    {"left/input/thumbstick/x", helm, 1.0, aboard},
    {"left/input/thumbstick/y", throttle, 1.0, aboard},
    {"right/input/thumbstick/y", sheet, -1.0, aboard},
    {"left/input/trigger/value", oar_left, 1.0, aboard},
    {"right/input/trigger/value", oar_right, 1.0, aboard},
    {"left/input/trigger/value", select_left},
    {"right/input/trigger/value", select_right},
    {"left/input/squeeze/value", grab_left},
    {"right/input/squeeze/value", grab_right},
    {"left/input/thumbstick/click", fast},
    {"right/input/thumbstick/click", recentre},
    {"left/input/x/click", board},
    {"left/input/y/click", light},
    {"left/input/menu/click", menu},
    {"right/input/a/click", teleport},
    {"right/input/b/click", swim},
};

constexpr ControllerBinding index[] = {
    {"left/input/thumbstick/x", move_x, 1.0, afoot},
    {"left/input/thumbstick/y", move_z, -1.0, afoot},
    {"right/input/thumbstick/x", turn},
    {"right/input/thumbstick/x", snap_turn},
    {"right/input/thumbstick/y", move_y, 1.0, afoot},
    {"left/input/thumbstick/x", helm, 1.0, aboard},
    {"left/input/thumbstick/y", throttle, 1.0, aboard},
    {"right/input/thumbstick/y", sheet, -1.0, aboard},
    {"left/input/trigger/value", oar_left, 1.0, aboard},
    {"right/input/trigger/value", oar_right, 1.0, aboard},
    {"left/input/trigger/value", select_left},
    {"right/input/trigger/value", select_right},
    {"left/input/squeeze/value", grab_left},
    {"right/input/squeeze/value", grab_right},
    {"left/input/thumbstick/click", fast},
    {"right/input/thumbstick/click", recentre},
    {"left/input/a/click", board},
    {"left/input/b/click", menu},
    {"left/input/trackpad/force", light},
    {"right/input/a/click", teleport},
    {"right/input/b/click", swim},
};

// A trackpad is touched all the time: it moves where it is pressed as a thumbstick is pushed.
constexpr ControllerBinding vive[] = {
    {"left/input/trackpad/x", move_x, 1.0, afoot},
    {"left/input/trackpad/y", move_z, -1.0, afoot},
    {"right/input/trackpad/x", turn},
    {"right/input/trackpad/x", snap_turn},
    {"right/input/trackpad/y", move_y, 1.0, afoot},
    {"left/input/trackpad/x", helm, 1.0, aboard},
    {"left/input/trackpad/y", throttle, 1.0, aboard},
    {"right/input/trackpad/y", sheet, -1.0, aboard},
    {"left/input/trigger/value", oar_left, 1.0, aboard},
    {"right/input/trigger/value", oar_right, 1.0, aboard},
    {"left/input/trigger/value", select_left},
    {"right/input/trigger/value", select_right},
    {"left/input/squeeze/click", grab_left},
    {"right/input/squeeze/click", grab_right},
    {"left/input/trackpad/click", fast},
    {"right/input/trackpad/click", teleport},
    {"left/input/menu/click", menu},
    {"right/input/menu/click", swim},
};

constexpr ControllerBinding mixed_reality[] = {
    {"left/input/thumbstick/x", move_x, 1.0, afoot},
    {"left/input/thumbstick/y", move_z, -1.0, afoot},
    {"right/input/thumbstick/x", turn},
    {"right/input/thumbstick/x", snap_turn},
    {"right/input/thumbstick/y", move_y, 1.0, afoot},
    {"left/input/thumbstick/x", helm, 1.0, aboard},
    {"left/input/thumbstick/y", throttle, 1.0, aboard},
    {"right/input/thumbstick/y", sheet, -1.0, aboard},
    {"left/input/trigger/value", oar_left, 1.0, aboard},
    {"right/input/trigger/value", oar_right, 1.0, aboard},
    {"left/input/trigger/value", select_left},
    {"right/input/trigger/value", select_right},
    {"left/input/squeeze/click", grab_left},
    {"right/input/squeeze/click", grab_right},
    {"left/input/thumbstick/click", fast},
    {"right/input/thumbstick/click", recentre},
    {"left/input/trackpad/click", board},
    {"right/input/trackpad/click", teleport},
    {"left/input/menu/click", menu},
    {"right/input/menu/click", swim},
};

constexpr ControllerBinding simple[] = {
    {"left/input/select/click", select_left},   {"left/input/select/click", teleport},
    {"right/input/select/click", select_right}, {"left/input/menu/click", menu},
    {"right/input/menu/click", recentre},
};

constexpr ControllerProfile profiles[] = {
    {"/interaction_profiles/oculus/touch_controller", "", touch},
    {"/interaction_profiles/meta/touch_controller_plus", "XR_META_touch_controller_plus", touch},
    {"/interaction_profiles/valve/index_controller", "", index},
    {"/interaction_profiles/htc/vive_controller", "", vive},
    {"/interaction_profiles/microsoft/motion_controller", "", mixed_reality},
    {"/interaction_profiles/khr/simple_controller", "", simple},
};

}  // namespace

std::span<const KeyBinding> key_bindings() { return keys; }

std::span<const GamepadBinding> gamepad_bindings() { return gamepad; }

double stick_value(double pushed) {
  constexpr double dead = 0.15;
  const double size = std::abs(pushed);
  return size <= dead ? 0.0 : std::copysign(std::min(1.0, (size - dead) / (1.0 - dead)), pushed);
}

void gather_gamepad(InputGatherer& gatherer, Post post, std::span<const unsigned char> buttons,
                    std::span<const float> axes) {
  for (const GamepadBinding& binding : gamepad) {
    const std::size_t which = std::size_t(binding.which);
    if (!holds_at(binding.post, post)) continue;
    double value = 0.0;
    if (binding.part == button)
      value = which < buttons.size() && buttons[which] ? 1.0 : 0.0;
    else if (which < axes.size())
      value = stick_value(binding.part == trigger ? 0.5 * (double(axes[which]) + 1.0) : double(axes[which]));
    if (value != 0.0) gatherer.add(binding.action, value * binding.value);
  }
}

std::span<const ControllerProfile> controller_profiles() { return profiles; }

Post controller_post(Action action) {
  for (const ControllerProfile& profile : profiles)
    for (const ControllerBinding& binding : profile.bindings)
      if (binding.action == action) return binding.post;
  return anywhere;
}

double controller_value(Action action) {
  for (const ControllerProfile& profile : profiles)
    for (const ControllerBinding& binding : profile.bindings)
      if (binding.action == action) return binding.value;
  return 1.0;
}

std::string mirrored(const ControllerProfile& profile, std::string_view path) {
  const auto has = [&](std::string_view wanted) {
    return std::any_of(profile.bindings.begin(), profile.bindings.end(),
                       [&](const ControllerBinding& binding) { return binding.path == wanted; });
  };
  const bool left = path.starts_with("left/");
  const std::string_view rest = path.substr(path.find('/'));
  constexpr std::string_view letters[][2] = {{"/input/x/click", "/input/a/click"},
                                             {"/input/y/click", "/input/b/click"}};
  const std::string other = left ? "right" : "left";
  for (const auto& [of_left, of_right] : letters) {
    const std::string_view from = left ? of_left : of_right, to = left ? of_right : of_left;
    if (rest == from && has(other + std::string(to))) return other + std::string(to);
  }
  const std::string same = other + std::string(rest);
  return has(same) || !rest.ends_with("/menu/click") ? same : std::string(path);
}

bool stays_with_its_hand(Action action) {
  return action == grab_left || action == grab_right || action == select_left || action == select_right ||
         action == oar_left || action == oar_right;
}

}  // namespace seascape
