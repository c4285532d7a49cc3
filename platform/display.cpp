#include "platform/display.h"

#include <algorithm>
#include <cmath>

namespace seascape {

std::uint32_t scaled_pixels(std::uint32_t pixels, double scale) {
  return std::uint32_t(std::max(1.0, std::round(double(pixels) * scale)));
}

const Input& Display::input() const {
  static const Input nothing;
  return nothing;
}

}  // namespace seascape
