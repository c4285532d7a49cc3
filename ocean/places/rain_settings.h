// Rain on the water: plain values, in SI units.
#pragma once
#include <cstdint>

namespace seascape {

struct RainSettings {
  double drops_per_m2_s = 0.0;  // drops a second on a square metre, 0 to 100
  double drop_length_m = 0.25;  // of the hump that one leaves (WaveSource), above 0
  double drop_height_m = 0.01;  // its height
  std::uint32_t seed = 1;       // another seed, other drops
};

// Throws Error naming the setting.
void validate(const RainSettings& settings);

}  // namespace seascape
