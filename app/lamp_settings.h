// The light that the viewer carries. Plain values.
#pragma once

namespace seascape {

enum class LampHeld { head, hand };

struct LampSettings {
  bool on = false;  // as the scene begins; the action `light` turns it on and off
  double candela = 20000.0;
  double beam_deg = 15.0;  // between the directions of half the middle's intensity
  double kelvin = 6500.0;  // of a black body of its colour
  LampHeld held = LampHeld::hand;
};

}  // namespace seascape
