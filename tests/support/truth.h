// Truths that the sea is held against: textbook formulas, adaptive quadrature and direct sums in double. Nothing here
// includes or repeats a line of the code it judges.
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>

namespace truth {

inline constexpr double pi = 3.14159265358979323846;

namespace detail {
inline double simpson(const std::function<double(double)>& f, double a, double fa, double b, double fb, double fm,
                      double whole, double tolerance, int depth) {
  const double m = 0.5 * (a + b), fl = f(0.5 * (a + m)), fr = f(0.5 * (m + b));
  const double left = (m - a) / 6.0 * (fa + 4.0 * fl + fm), right = (b - m) / 6.0 * (fm + 4.0 * fr + fb);
  const double error = left + right - whole;
  if (depth <= 0 || std::abs(error) <= 15.0 * tolerance) return left + right + error / 15.0;
  return simpson(f, a, fa, m, fm, fl, left, tolerance / 2, depth - 1) +
         simpson(f, m, fm, b, fb, fr, right, tolerance / 2, depth - 1);
}
}  // namespace detail

// Adaptive Simpson quadrature over [a, b], first cut into `pieces` so that a narrow peak is not missed.
inline double integral(const std::function<double(double)>& f, double a, double b, double tolerance, int pieces = 64) {
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double x0 = a + (b - a) * i / pieces, x1 = a + (b - a) * (i + 1) / pieces;
    const double f0 = f(x0), f1 = f(x1), fm = f(0.5 * (x0 + x1));
    sum += detail::simpson(f, x0, f0, x1, f1, fm, (x1 - x0) / 6.0 * (f0 + 4.0 * fm + f1), tolerance / pieces, 40);
  }
  return sum;
}

// What a tile of `samples` texels a side must carry of wave (mx, mz), of height 1, so that straight lines between
// texels fit it: the best fit of a wave to its own linear interpolation has sinc^2(m / samples) of it an axis; counted
// down to four texels a wave.
inline double raised(int mx, int mz, int samples) {
  const auto axis = [&](int m) {
    const double x = pi * std::min(std::abs(m) / double(samples), 0.25);
    return x > 0.0 ? std::pow(x / std::sin(x), 2) : 1.0;
  };
  return axis(mx) * axis(mz);
}

// Significant height of the fully developed sea of Pierson and Moskowitz (1964), wind at 19.5 m.
inline double pierson_moskowitz_hs(double u19, double g) { return 0.20925 * u19 * u19 / g; }

// JONSWAP's density over w (Hasselmann et al. 1973, eq. 2.4.4).
inline double jonswap(double w, double alpha, double peak, double gamma, double g) {
  const double sigma = w > peak ? 0.09 : 0.07;
  const double exponent = std::exp(-std::pow(w - peak, 2) / (2.0 * sigma * sigma * peak * peak));
  return alpha * g * g * std::pow(w, -5.0) * std::exp(-1.25 * std::pow(peak / w, 4.0)) * std::pow(gamma, exponent);
}

}  // namespace truth
