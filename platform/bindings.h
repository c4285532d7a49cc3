// Which key, button or stick asks for which action: tables that a newcomer can read, and nothing else. Pure.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "platform/actions.h"
#include "platform/input.h"

namespace seascape {

// Where a binding holds: in a boat sticks and keys steer it.
enum class Post { anywhere, afoot, aboard };
constexpr bool holds_at(Post binding, Post now) { return binding == Post::anywhere || binding == now; }

struct KeyBinding {
  int key;  // GLFW_KEY_*: where it sits, by what a US keyboard has there
  Action action;
  double value = 1.0;
  Post post = Post::anywhere;
};
std::span<const KeyBinding> key_bindings();

// Of a gamepad as GLFW lays all of them out.
struct GamepadBinding {
  enum class Part { button, stick, trigger };  // a trigger rests at -1
  Part part;
  int which;  // GLFW_GAMEPAD_BUTTON_* or GLFW_GAMEPAD_AXIS_*
  Action action;
  double value = 1.0;  // when pressed, or at the stick's positive end
  Post post = Post::anywhere;
};
std::span<const GamepadBinding> gamepad_bindings();
// What a stick (-1 to 1) gives: nothing near its middle, where it never quite rests.
double stick_value(double pushed);
// Adds what a gamepad says, by GLFW's numbers of buttons (0 or 1) and axes (-1 to 1), to a frame's actions.
void gather_gamepad(InputGatherer& gatherer, Post post, std::span<const unsigned char> buttons,
                    std::span<const float> axes);

// Of a headset's controller. Paths are OpenXR's, below /user/hand/.
struct ControllerBinding {
  std::string_view path;  // "left/input/trigger/value"
  Action action;
  double value = 1.0;  // at the input's positive end
  Post post = Post::anywhere;
};
struct ControllerProfile {
  std::string_view path;       // "/interaction_profiles/..."
  std::string_view extension;  // without which it is not asked for; empty: OpenXR's own
  std::span<const ControllerBinding> bindings;
};
std::span<const ControllerProfile> controller_profiles();
// Of an action, the same in all profiles: where it holds, and what the input's positive end gives.
Post controller_post(Action action);
double controller_value(Action action);

// The input of the other hand that stands for this one, for the left-handed: of the same name, or x and y for a and b
// where the hands' controllers differ. One that no other hand has stays. What grabs and points stays with its hand.
std::string mirrored(const ControllerProfile& profile, std::string_view path);
bool stays_with_its_hand(Action action);

}  // namespace seascape
