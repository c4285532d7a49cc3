#include "ocean/waves/elfouhaily.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {
constexpr double oldest = 0.84, youngest = 5.0;
constexpr double karman = 0.4;
constexpr double longest_number =
    1e100;  // rad/m: beyond, squares of speeds are more than any double, and long since there are no waves
constexpr double most_drag_root = 0.05;     // u* / U10 grows no more in a hurricane: drag 2.5e-3 (Donelan et al. 2004)
constexpr double viscosity_m2_s = 1.05e-6;  // of sea water at 20 degrees C

// u* of a wind over waves of an age: roughness z0 = 3.7e-5 (U10^2 / g) age^0.9 (eq. 66, after Donelan et al. 1993) in a
// logarithmic profile.
double friction_velocity(double wind, double age, double gravity) {
  const double roughness = 3.7e-5 * wind * wind / gravity * std::pow(age, 0.9);
  return wind * karman / std::max(std::log(10.0 / roughness), karman / most_drag_root);
}
}  // namespace

double inverse_wave_age(double fetch_over_wind_length) {
  if (!(fetch_over_wind_length > 0.0)) return youngest;
  return std::min(oldest * std::pow(std::tanh(std::pow(fetch_over_wind_length / 2.2e4, 0.4)), -0.75), youngest);
}

Elfouhaily::Elfouhaily(double wind_mps, double age, double gravity_mps2)
    : age_(std::clamp(age, oldest, youngest)), gravity_(gravity_mps2) {
  peak_ = gravity_ * age_ * age_ / (wind_mps * wind_mps);
  peak_speed_ = wind_mps / age_;
  friction_ = friction_velocity(wind_mps, age_, gravity_);
  slowest_ = std::sqrt(gravity_ / water_tension_m3_s2);
  slowest_speed_ = std::sqrt(2.0 * gravity_ / slowest_);
  alpha_p_ = 6e-3 * std::sqrt(age_);  // eq. 34
  // Eq. 44; below u* = cm / e, a wind of about 2.5 m/s, there are no short waves of their own.
  const double ratio = std::log(friction_ / slowest_speed_);
  alpha_m_ = std::max(0.0, 0.01 * (1.0 + (ratio <= 0.0 ? ratio : 3.0 * ratio)));
  gamma_ = age_ <= 1.0 ? 1.7 : 1.7 + 6.0 * std::log10(age_);  // eq. 3
  width_ = 0.08 * (1.0 + 4.0 / (age_ * age_ * age_));
}

Elfouhaily::Parts Elfouhaily::parts(double k) const {
  const double speed = std::sqrt(gravity_ / k * (1.0 + k / slowest_ * (k / slowest_)));
  const double ratio = peak_ / k;
  if (1.25 * ratio * ratio > 700.0) return {0.0, 0.0, speed};
  const double root = std::sqrt(1.0 / ratio) - 1.0, shape = std::exp(-1.25 * ratio * ratio);
  const double enhanced = std::exp(std::log(gamma_) * std::exp(-0.5 * root * root / (width_ * width_)));
  // Eqs. 31 and 32, 40 and 41.
  const double low = 0.5 * alpha_p_ * peak_speed_ / speed * shape * enhanced * std::exp(-age_ / std::sqrt(10.0) * root);
  const double d = k / slowest_ - 1.0;
  return {low, 0.5 * alpha_m_ * slowest_speed_ / speed * shape * std::exp(-0.25 * d * d), speed};
}

double Elfouhaily::curvature(double k) const {
  if (!(k > 0.0 && k < longest_number)) return 0.0;
  const Parts p = parts(k);
  return p.low + p.high;
}

double Elfouhaily::tail_curvature(double k) const {
  if (!(k > 0.0 && k < longest_number)) return 0.0;
  const Parts p = parts(k);
  // Energy grows by 0.04 (u* / c)^2 w (Plant 1982) and is drained by 4 nu k^2 (Lamb 1932, art. 348).
  const double push = friction_ / p.speed, growth = 0.04 * push * push * p.speed * k;
  return p.low * std::max(0.0, 1.0 - 4.0 * viscosity_m2_s * k * k / growth) + p.high;
}

double Elfouhaily::delta(double k) const {
  if (!(k > 0.0)) return 0.0;
  const double speed = std::sqrt(gravity_ / k * (1.0 + k / slowest_ * (k / slowest_)));
  constexpr double a0 = std::numbers::ln2 / 4.0, ap = 4.0;  // eq. 59
  const double am = 0.13 * friction_ / slowest_speed_;
  return std::tanh(a0 + ap * std::pow(speed / peak_speed_, 2.5) + am * std::pow(slowest_speed_ / speed, 2.5));
}

}  // namespace seascape
