// Light of sRGB values and back (IEC 61966-2-1), both from 0 to 1.
#pragma once
#include <cmath>

namespace seascape {

inline double srgb_to_light(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

inline double light_to_srgb(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

}  // namespace seascape
