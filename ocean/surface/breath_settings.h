// What a diver breathes out under water. Plain values.
#pragma once
#include <cstdint>

namespace seascape {

struct BreathSettings {
  bool on = true;
  double every_s = 5.0;    // from breath to breath, 1 to 30
  double litres = 0.8;     // of a breath, where it is breathed out, 0.1 to 4
  std::uint32_t seed = 1;  // which of the same statistics
};

}  // namespace seascape
