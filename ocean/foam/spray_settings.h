// Spray as the wind tears it off breaking crests: how much, how far around the viewer, how long it stays aloft. Plain
// values, in SI units.
#pragma once
#include <cstdint>

namespace seascape {

struct SpraySettings {
  double amount = 1.0;     // 0 none to 4: times spray_per_m2_s
  int most = 6000;         // puffs aloft at once, 64 to 32768; more are thinned evenly
  double range_m = 75.0;   // around the viewer, 10 to 300; fewer from two thirds of it on
  double life_s = 2.5;     // the longest that a puff is seen, 0.2 to 6
  double size = 1.0;       // of puffs, times 6 to 36 cm of radius where they begin, 0.25 to 4
  double rate_hz = 12.0;   // steps a second, 4 to 60
  std::uint32_t seed = 1;  // which of the same statistics
};

// How many puffs a square metre that breaks throws up in a second, on a steep crest well above the still sea in a wind
// of 15 m/s.
inline constexpr double spray_per_m2_s = 12.0;

// Throws Error naming the setting.
void validate(const SpraySettings& settings);

}  // namespace seascape
