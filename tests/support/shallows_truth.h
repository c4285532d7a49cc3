// Truths of waves over a bed: shoaling from Airy's theory with wave numbers by bisection, Snell's law on a plane beach.
// Nothing here includes or repeats a line of the code it judges.
#pragma once
#include <cmath>
#include <map>

#include "tests/support/spectrum_truth.h"

namespace truth {

// dw/dk = (w / k) (1/2 + k h / sinh 2 k h).
inline double energy_speed(double k, double g, double h) {
  const double kh = k * h;
  return airy(k, g, h) / k * (0.5 + (kh < 300.0 ? kh / std::sinh(2.0 * kh) : 0.0));
}
// Height at a depth over that where the waves come from, by their wave number there.
inline double shoaling(double k, double g, double h, double from_h) {
  return std::sqrt(energy_speed(k, g, from_h) / energy_speed(airy_inverse(airy(k, g, from_h), g, h), g, h));
}

// Waves as variance by wave number where they come from.
using Train = std::map<double, double>;

inline double variance(const Train& train) {
  double sum = 0.0;
  for (const auto& [k, v] : train) sum += v;
  return sum;
}
// Variance at a depth, nothing broken; a train's heights grow fourfold at most.
inline double shoaled_variance(const Train& train, double g, double h, double from_h) {
  double sum = 0.0;
  for (const auto& [k, v] : train) sum += v * std::pow(shoaling(k, g, h, from_h), 2.0);
  return std::min(sum, 16.0 * variance(train));
}
// Of a significant height what is left in depth h: (H^-6 + (0.42 sqrt(2) h)^-6)^(-1/6).
inline double broken(double height, double h) {
  return std::pow(std::pow(height, -6.0) + std::pow(0.42 * std::sqrt(2.0) * h, -6.0), -1.0 / 6.0);
}

}  // namespace truth
