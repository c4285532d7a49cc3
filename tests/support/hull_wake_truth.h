// Truths of the waves that hulls leave: Michell's integral, and the same of any set of sources. Nothing here includes
// or repeats a line of the code it judges.
#pragma once
#include <cmath>
#include <complex>
#include <functional>

#include "tests/support/truth.h"

namespace truth {

// The drag (N) of steady waves on deep water from what a source distribution sends in each direction theta: with S(k
// cos theta, k sin theta) = the sum of q exp(-k depth + i (kx x + kz z)), q in m^3/s, k = g / U^2 / cos^2 theta, R =
// rho (g / U^2)^2 / pi times the integral of |S|^2 / cos^3 theta from 0 to pi / 2 (Michell 1898; Havelock 1932); of
// one that is not the same on both sides from -pi / 2, halved.
inline double wave_drag(double speed_mps, double gravity, double density,
                        const std::function<std::complex<double>(double kx, double kz)>& sent) {
  const double k0 = gravity / (speed_mps * speed_mps);
  constexpr int pieces = 4000;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double theta = (double(i) + 0.5) / pieces * pi - 0.5 * pi, c = std::cos(theta), k = k0 / (c * c);
    sum += std::norm(sent(k * c, k * std::sin(theta))) / (c * c * c);
  }
  return density * k0 * k0 / pi * 0.5 * sum * pi / pieces;
}

// What the hull of Wigley (1942), y = B/2 (1 - (2x/L)^2) (1 - (z/T)^2), sends: -2 U dy/dx over its centre plane.
inline std::complex<double> wigley_sends(double length, double beam, double draught, double speed_mps, double kx,
                                         double kz) {
  const double k = std::hypot(kx, kz), a = 0.5 * length, d = k * draught,
               along = 2.0 * (std::sin(kx * a) / (kx * kx) - a * std::cos(kx * a) / kx);
  // Of (1 - u^2) exp(-d u) over u from 0 to 1.
  const double down = d < 1e-3
                          ? 2.0 / 3.0 - d / 4.0
                          : (1.0 - std::exp(-d)) / d - (2.0 - std::exp(-d) * (d * d + 2.0 * d + 2.0)) / (d * d * d);
  return {0.0, 2.0 * speed_mps * 0.5 * beam * 8.0 / (length * length) * along * draught * down};
}

}  // namespace truth
