// The chance by which spray is thrown: numbers that follow from seed, place and step alone.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "ocean/foam/spray.h"
#include "ocean/waves/split_mix.h"

namespace seascape {

// Numbers of a place and a step of their own.
class Spray::Chance {
 public:
  explicit Chance(std::uint64_t key) : key_(key) {}
  Chance of(std::int64_t part) const {
    return Chance(split_mix(key_ ^ split_mix(std::uint64_t(part) + split_mix_step)));
  }
  double next() { return share_of(split_mix(key_ += split_mix_step)); }  // in [0, 1)
  double normal() {
    const double r = std::sqrt(-2.0 * std::log(1.0 - next()));
    return r * std::cos(2.0 * std::numbers::pi * next());
  }

 private:
  std::uint64_t key_;
};

// Of spray: diameters, and of drops that are told apart.
inline constexpr double finest_drop_m = 6e-5, coarsest_drop_m = 2e-3, drop_seen_from_m = 5e-4, drop_seen_by_m = 1.2e-3;

inline double smooth_between(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace seascape
