// Truths of linear water waves: how fast they run, where the wake of a travelling pressure stands, how a ring spreads.
// Nothing here includes or repeats a line of the code it judges.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/truth.h"

namespace truth {

// Airy (1845).
inline double water_frequency(double k, double g, double depth) { return std::sqrt(g * k * std::tanh(k * depth)); }

// Half the opening of the wake: Kelvin (1887).
inline double kelvin_degrees() { return std::asin(1.0 / 3.0) * 180.0 / pi; }

// Where a pressure exp(-pi^2 r^2 / b^2) that travels at Fr = U / sqrt(g b) is said to leave the highest waves (Darmon,
// Benzaquen and Raphael 2014): the ray of the waves with k = 2 pi / b. By the integral below that is where k^2 times
// the pressure's transform is greatest: nearer to where the wake is steepest (10.6 degrees at Fr 1 far behind) than to
// where it is highest (13.6, the formula 11.2).
inline double highest_degrees(double froude) {
  const double f = 2.0 * pi * froude * froude;
  return std::atan(std::sqrt(f - 1.0) / (2.0 * f - 1.0)) * 180.0 / pi;
}

// How high (moment 0) or steep (1) the waves are behind such a pressure in deep water, b = 1 long, but for a factor:
// the waves of Havelock's (1908) steady pattern, of which each direction tan^-1(tau) has the one wave number that
// stands still, k = (1 + tau^2) / Fr^2: the absolute value of the integral over tau of (1 + tau^2) k^moment share(k)
// exp(-k^2 / 4 pi^2) exp(i k.x).
inline double wake_amplitude(double froude, double behind, double across, int moment,
                             const std::function<double(double)>& share) {
  const double k0 = 1.0 / (froude * froude), most = std::sqrt(std::max(30.0 / k0, 2.0));
  constexpr int pieces = 1000;
  double re = 0.0, im = 0.0;
  for (int i = -pieces; i <= pieces; ++i) {
    const double tau = most * i / pieces, s = std::sqrt(1.0 + tau * tau), k = k0 * s * s,
                 phase = k0 * s * (behind + across * tau);
    const double weight = s * s * std::pow(k, moment) * share(k) * std::exp(-k * k / (4.0 * pi * pi));
    re += weight * std::cos(phase), im += weight * std::sin(phase);
  }
  return std::hypot(re, im);
}

// Ai(0) / max Ai: where rays of a wake fold over, along Kelvin's line, waves are this much of the highest that stand
// just within.
inline double airy_at_fold() { return 0.355028 / 0.535657; }

// Height at distance r and time t after the level was raised by rise exp(-pi^2 r^2 / b^2) at rest: integral over k of
// the Gaussian's transform, cos(w t) and J0(k r) (Lamb 1932, art. 238), waves counted by share(k).
inline double ring_height(double rise, double b, double r, double t, double g, double depth,
                          const std::function<double(double)>& share) {
  return integral(
      [&](double k) {
        return k <= 0.0
                   ? 0.0
                   : share(k) * rise * b * b / pi * std::exp(-k * k * b * b / (4.0 * pi * pi)) *
                         std::cos(water_frequency(k, g, depth) * t) * std::cyl_bessel_j(0.0, k * r) * k / (2.0 * pi);
      },
      0.0, 6.0 * 2.0 * pi / b, 1e-9 * rise, 512);
}

}  // namespace truth
