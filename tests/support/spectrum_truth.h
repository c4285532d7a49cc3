// Truths of waves and their spectra: textbook formulas in their authors' own variables, roots by bisection, integrals
// by adaptive quadrature. Nothing here includes or repeats a line of the code it judges.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/truth.h"

namespace truth {

// Airy's dispersion; surface tension over density optional.
inline double airy(double k, double g, double h, double tension = 0.0) {
  return std::sqrt((g * k + tension * k * k * k) * std::tanh(k * h));
}

// The wave number of a frequency, by bisection of w^2 = g k tanh(k h) to the last bits.
inline double airy_inverse(double w, double g, double h) {
  double low = 0.0, high = w * w / g + w / std::sqrt(g * h);
  for (int i = 0; i < 200; ++i) {
    const double mid = 0.5 * (low + high);
    (airy(mid, g, h) < w ? low : high) = mid;
  }
  return 0.5 * (low + high);
}

// Pierson and Moskowitz (1964): alpha g^2 w^-5 exp(-0.74 (g / (U19.5 w))^4).
inline double pierson_moskowitz(double w, double u19, double g) {
  return 0.0081 * g * g / std::pow(w, 5) * std::exp(-0.74 * std::pow(g / (u19 * w), 4));
}

// JONSWAP of a wind at 10 m and a fetch, as Hasselmann et al. (1973) fitted it, its peak and its energy held at Pierson
// and Moskowitz's (U19.5 = 1.026 U10).
struct Jonswap {
  Jonswap(double u10, double fetch, double g_, double gamma_ = 3.3) : g(g_), gamma(gamma_) {
    const double u19 = 1.026 * u10, lowest = std::pow(4.0 * 0.74 / 5.0, 0.25) * g / u19;
    // The fetch from which on the peak stays: 22 (g / U) X^-1/3 = lowest.
    const double x = std::min(g * fetch / (u10 * u10), std::pow(22.0 * g / (u10 * lowest), 3.0));
    peak = 22.0 * std::cbrt(g * g / (u10 * (x * u10 * u10 / g)));
    alpha = 0.076 * std::pow(x, -0.22);
    const double most = 0.0081 * std::pow(u19, 4) / (4.0 * 0.74 * g * g), has = energy();
    if (has > most) alpha *= most / has;
  }
  double at(double w) const { return jonswap(w, alpha, peak, gamma, g); }
  double energy() const {
    return integral([&](double s) { return std::exp(s) * at(std::exp(s)); }, std::log(0.3 * peak),
                    std::log(300.0 * peak), 1e-9 * alpha * g * g * std::pow(peak, -4), 400);
  }
  double g, gamma, alpha = 0.0, peak = 1.0;
};

// Kitaigorodskii's factor: exact, k_h^-3 (dk/dw)_h over k_deep^-3 (dk/dw)_deep = tanh^2(kh) / (1 + 2 kh / sinh 2kh),
// and in the two parabolas of Thompson and Vincent (1983).
inline double depth_factor_exact(double w, double g, double h) {
  const double kh = airy_inverse(w, g, h) * h;
  return std::pow(std::tanh(kh), 2) / (1.0 + 2.0 * kh / std::sinh(2.0 * kh));
}
inline double depth_factor(double w, double g, double h) {
  const double wh = w * std::sqrt(h / g);
  return wh < 1.0 ? wh * wh / 2.0 : wh < 2.0 ? 1.0 - std::pow(2.0 - wh, 2) / 2.0 : 1.0;
}

// Spreadings without their norms, angle from the mean direction.
inline double mitsuyasu(double angle, double r, double u_over_cp) {  // r = f / fp
  const double s = 11.5 * std::pow(u_over_cp, -2.5) * (r < 1.0 ? std::pow(r, 5.0) : std::pow(r, -2.5));
  return std::pow(std::abs(std::cos(angle / 2.0)), 2.0 * s);
}
inline double hasselmann(double angle, double r, double u_over_cp) {
  const double mu = -2.33 - 1.45 * (u_over_cp - 1.17);
  const double s = r < 1.05 ? 6.97 * std::pow(r, 4.06) : 9.77 * std::pow(r, mu);
  return std::pow(std::abs(std::cos(angle / 2.0)), 2.0 * s);
}
inline double donelan_banner(double angle, double r) {
  double beta = 2.61 * std::pow(std::max(r, 0.56), 1.3);
  if (r >= 0.95) beta = 2.28 * std::pow(r, -1.3);
  if (r >= 1.6) beta = std::pow(10.0, -0.4 + 0.8393 * std::exp(-0.567 * std::log(r * r)));
  return std::pow(std::cosh(beta * angle), -2.0);
}
inline double elongation(double angle, double r, double swell) {
  return std::pow(std::abs(std::cos(angle / 2.0)), 32.0 * std::tanh(1.0 / r) * swell * swell);
}

// Elfouhaily et al. (1997): the curvature spectrum of wind U at inverse wave age W over deep water, and its Delta.
struct Elfouhaily {
  Elfouhaily(double u10, double age, double g_) : g(g_), w(age), u(u10) {
    km = std::sqrt(g / 7.17e-5);
    cm = std::sqrt(2.0 * g / km);
    const double z0 = 3.7e-5 * u * u / g * std::pow(w, 0.9);
    friction = std::min(0.4 / std::log(10.0 / z0), 0.05) * u;
  }
  double c(double k) const { return std::sqrt(g / k * (1.0 + std::pow(k / km, 2))); }
  double low(double k) const {
    const double kp = g * w * w / (u * u), cp = u / w, sigma = 0.08 * (1.0 + 4.0 * std::pow(w, -3.0));
    const double gamma = w > 1.0 ? 1.7 + 6.0 * std::log10(w) : 1.7;
    const double peak = std::pow(gamma, std::exp(-std::pow(std::sqrt(k / kp) - 1.0, 2) / (2.0 * sigma * sigma)));
    return 0.5 * 6e-3 * std::sqrt(w) * cp / c(k) * std::exp(-1.25 * std::pow(kp / k, 2)) * peak *
           std::exp(-w / std::sqrt(10.0) * (std::sqrt(k / kp) - 1.0));
  }
  double high(double k) const {
    const double kp = g * w * w / (u * u), ln = std::log(friction / cm);
    const double alpha = std::max(0.0, 0.01 * (1.0 + (friction < cm ? ln : 3.0 * ln)));
    return 0.5 * alpha * cm / c(k) * std::exp(-1.25 * std::pow(kp / k, 2)) *
           std::exp(-0.25 * std::pow(k / km - 1.0, 2));
  }
  // What wind gives less what viscosity takes, over what wind gives (Plant 1982; Lamb 1932).
  double fed(double k) const {
    const double given = 0.04 * std::pow(friction / c(k), 2) * c(k) * k, taken = 4.0 * 1.05e-6 * k * k;
    return std::max(0.0, (given - taken) / given);
  }
  double delta(double k) const {
    return std::tanh(std::log(2.0) / 4.0 + 4.0 * std::pow(c(k) * w / u, 2.5) +
                     0.13 * friction / cm * std::pow(cm / c(k), 2.5));
  }
  double g, w, u, km, cm, friction;
};

// The share of short waves, from 12 m (or a tenth of the peak wave) to 0.3 m (or a quarter of that).
inline double short_share(double k, double peak_k) {
  const double from = std::max(2.0 * pi / 12.0, 10.0 * peak_k), to = std::max(2.0 * pi / 0.3, 4.0 * from);
  const double t = std::min(1.0, std::max(0.0, (std::log(k) - std::log(from)) / (std::log(to) - std::log(from))));
  return 3.0 * t * t - 2.0 * t * t * t;
}

// Variance density over the wave number (m^3) of the joined wind sea in deep water: JONSWAP and Elfouhaily's tail.
inline double joined(const Jonswap& j, const Elfouhaily& e, double k) {
  const double w = std::sqrt(j.g * k), share = short_share(k, j.peak * j.peak / j.g);
  return (1.0 - share) * j.at(w) * 0.5 * std::sqrt(j.g / k) + share * (e.low(k) * e.fed(k) + e.high(k)) / (k * k * k);
}

// Mean square slopes of a clean sea (Cox and Munk 1954), wind at 41 ft = 12.5 m.
struct Slopes {
  double up, cross;
};
inline Slopes cox_munk(double u12) { return {3.16e-3 * u12, 0.003 + 1.92e-3 * u12}; }
// A wind at 12.5 m from one at 10 m and the friction velocity, in a logarithmic profile.
inline double wind_at_12(double u10, double friction) { return u10 + friction / 0.4 * std::log(12.5 / 10.0); }

}  // namespace truth
