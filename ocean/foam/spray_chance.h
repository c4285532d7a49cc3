// The chance by which spray is thrown: numbers that follow from seed, place and step alone.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "ocean/foam/spray.h"

namespace seascape {

// Numbers of a place and a step of their own (SplitMix64: Steele, Lea and Flood 2014).
class Spray::Chance {
 public:
  explicit Chance(std::uint64_t key) : key_(key) {}
  Chance of(std::int64_t part) const { return Chance(mixed(key_ ^ mixed(std::uint64_t(part) + golden))); }
  double next() { return double(mixed(key_ += golden) >> 11) * 0x1p-53; }  // in [0, 1)
  double normal() {
    const double r = std::sqrt(-2.0 * std::log(1.0 - next()));
    return r * std::cos(2.0 * std::numbers::pi * next());
  }

 private:
  static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
};

// Of spray: diameters, and of drops that are told apart.
inline constexpr double finest_drop_m = 6e-5, coarsest_drop_m = 2e-3, drop_seen_from_m = 5e-4, drop_seen_by_m = 1.2e-3;

inline double smooth_between(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace seascape
