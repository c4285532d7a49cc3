// What a window's keys and mouse did since the last frame.
#pragma once
#include <bitset>
#include <glm/glm.hpp>
#include <vector>

namespace seascape {

// Keys by what is printed on them in the US layout, where they sit.
enum class Key {
  w,
  a,
  s,
  d,
  q,
  e,
  p,
  r,
  v,
  one,
  two,
  three,
  left_bracket,
  right_bracket,
  comma,
  period,
  space,
  tab,
  escape,
  shift,
  control,
  f1,
  f2,
  count
};

struct Input {
  std::bitset<std::size_t(Key::count)> held;  // down now
  std::vector<Key> pressed;                   // went down since the last frame, in order, repeats excepted
  glm::dvec2 mouse_pixels{0.0};               // how far the mouse moved, x to the right, y down
  double wheel = 0.0;                         // notches, away from the hand positive
  bool right_button = false;                  // down now

  bool is_held(Key key) const { return held[std::size_t(key)]; }
};

}  // namespace seascape
