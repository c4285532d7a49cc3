#include "ocean/waves/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/error.h"
#include "engine/text.h"

namespace seascape {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double swell_gamma = 6.0;
constexpr double swell_s = 25.0;
constexpr double u19_over_u10 = 1.026;  // Pierson and Moskowitz measured at 19.5 m
constexpr double pm_alpha = 0.0081, pm_beta = 0.74;  // Pierson and Moskowitz (1964)
constexpr double suppressed_below_m = 2.0;

void require(double value, double least, double most, const char* key) {
  if (value >= least && value <= most) return;  // false for NaN
  throw Error(key, text_from(value) + " is not in the range " + text_from(least) + " to " + text_from(most),
              "give a finite number in that range");
}

// m0 wp^4 / (alpha g^2) of a JONSWAP train: 1/5 for gamma 1. Trapezoids over s = ln(w/wp), which converge exponentially
// for this smooth, decaying integrand apart from the small kink of sigma at the peak, which is a node.
double shape_integral(double gamma) {
  constexpr int nodes_below = 1500, nodes_above = 6000;
  constexpr double step = 0.001;
  double sum = 0.0;
  const WaveTrain unit{1.0, 1.0, gamma, 0.0};
  for (int i = -nodes_below; i <= nodes_above; ++i) {
    const double w = std::exp(i * step);
    sum += frequency_density(unit, 1.0, w) * w;
  }
  return sum * step;
}

// Angle from the direction a train travels to, in (-pi, pi].
double angle_between(double a, double b) { return std::remainder(a - b, 2.0 * pi); }

WaveTrain wind_train(const SeaState& sea) {
  WaveTrain train;
  train.gamma = sea.peak_enhancement;
  train.to_rad = sea.wind_to_deg * pi / 180.0;
  const double g = sea.gravity_mps2, u = sea.wind_speed_mps;
  const double x = u > 0.0 ? g * sea.fetch_m / (u * u) : 0.0;
  // Below these the waves would be shorter than a hundredth of a millimetre: flat, and nothing overflows.
  if (u < 1e-3 || x < 1e-6) return train;
  const double u19 = u19_over_u10 * u;
  const double developed_peak = std::pow(0.8 * pm_beta, 0.25) * g / u19;
  // Past the fetch at which the peak is fully developed the sea grows no more: alpha, which falls with fetch, is held too.
  const double developed_root = 22.0 * (g / u) / developed_peak;
  const double grown = std::min(x, developed_root * developed_root * developed_root);
  train.peak_rad_s = 22.0 * (g / u) * std::pow(grown, -1.0 / 3.0);
  const double developed_variance = pm_alpha * u19 * u19 * u19 * u19 / (4.0 * pm_beta * g * g);
  const double p = train.peak_rad_s;
  const double most = developed_variance * p * p * p * p / (g * g * shape_integral(train.gamma));
  train.alpha = std::min(0.076 * std::pow(grown, -0.22), most);
  return train;
}

WaveTrain swell_train(const SeaState& sea) {
  WaveTrain train;
  train.gamma = swell_gamma;
  train.to_rad = sea.swell_to_deg * pi / 180.0;
  train.peak_rad_s = 2.0 * pi / sea.swell_period_s;
  const double variance = sea.swell_height_m * sea.swell_height_m / 16.0;
  const double p = train.peak_rad_s, g = sea.gravity_mps2;
  if (variance > 0.0) train.alpha = variance * p * p * p * p / (g * g * shape_integral(train.gamma));
  return train;
}
}  // namespace

void validate(const SeaState& sea) {
  require(sea.wind_speed_mps, 0.0, 100.0, "waves.wind_speed_mps");
  require(sea.wind_to_deg, -3600.0, 3600.0, "waves.wind_to_deg");
  require(sea.fetch_m, 0.0, 1e12, "waves.fetch_m");
  require(sea.peak_enhancement, 1.0, 20.0, "waves.peak_enhancement");
  require(sea.swell_height_m, 0.0, 50.0, "waves.swell_height_m");
  require(sea.swell_period_s, 0.5, 60.0, "waves.swell_period_s");
  require(sea.swell_to_deg, -3600.0, 3600.0, "waves.swell_to_deg");
  require(sea.chop, 0.0, 2.0, "waves.chop");
  require(sea.small_wave_suppression, 0.0, 1.0, "waves.small_wave_suppression");
  require(sea.gravity_mps2, 0.01, 1000.0, "waves.gravity_mps2");
}

void validate(const WaveQuality& quality) {
  const int n = quality.resolution;
  if (n < 16 || n > 512 || (n & (n - 1)) != 0)
    throw Error("waves.resolution", std::to_string(n) + " is not a power of two from 16 to 512",
                "give 16, 32, 64, 128, 256 or 512");
  if (quality.cascades < 1 || quality.cascades > 5)
    throw Error("waves.cascades", std::to_string(quality.cascades) + " is not in the range 1 to 5",
                "give a whole number in that range");
}

glm::dvec2 direction_xz(double degrees) {
  const double a = degrees * pi / 180.0;
  return {std::sin(a), -std::cos(a)};
}

double longest_peak_wave_m(const SeaState& sea) {
  validate(sea);
  double longest = 0.0;
  for (const WaveTrain& train : {wind_train(sea), swell_train(sea)})
    if (train.alpha > 0.0)
      longest = std::max(longest, 2.0 * pi * sea.gravity_mps2 / (train.peak_rad_s * train.peak_rad_s));
  return longest;
}

double frequency_density(const WaveTrain& train, double gravity_mps2, double w) {
  if (train.alpha == 0.0 || !(w > 0.0)) return 0.0;
  const double ratio = train.peak_rad_s / w;
  const double r4 = ratio * ratio * ratio * ratio;
  if (1.25 * r4 > 700.0) return 0.0;
  const double sigma = w <= train.peak_rad_s ? 0.07 : 0.09;
  const double d = (w / train.peak_rad_s - 1.0) / sigma;
  const double w5 = w * w * w * w * w;
  return train.alpha * gravity_mps2 * gravity_mps2 / w5 * std::exp(-1.25 * r4 + std::log(train.gamma) * std::exp(-0.5 * d * d));
}

double wind_spreading(double angle_rad, double w_over_peak) {
  // Donelan et al. (1985) eq. 6.2 and Banner (1990), as collected by Horvath (2015) eq. 38; held below 0.56.
  const double r = std::max(w_over_peak, 0.56);
  double beta;
  if (r < 0.95)
    beta = 2.61 * std::pow(r, 1.3);
  else if (r < 1.6)
    beta = 2.28 * std::pow(r, -1.3);
  else
    beta = std::pow(10.0, -0.4 + 0.8393 * std::exp(-0.567 * 2.0 * std::log(r)));
  const double sech = 1.0 / std::cosh(beta * angle_rad);
  return 0.5 * beta / std::tanh(beta * pi) * sech * sech;
}

double swell_spreading(double angle_rad) {
  // 1 / integral of cos^2s(angle / 2) = Gamma(s + 1) / (2 sqrt(pi) Gamma(s + 1/2)), made once: lgamma is slow.
  static const double norm = std::exp(std::lgamma(swell_s + 1.0) - std::lgamma(swell_s + 0.5)) / (2.0 * std::sqrt(pi));
  const double c = std::cos(0.5 * angle_rad);
  return norm * std::pow(c * c, swell_s);
}

Spectrum::Spectrum(const SeaState& sea) : gravity_(sea.gravity_mps2), suppression_(sea.small_wave_suppression) {
  validate(sea);
  wind_ = wind_train(sea);
  swell_ = swell_train(sea);
}

double Spectrum::frequency(double k) const { return std::sqrt(gravity_ * k); }

double Spectrum::suppression(double k) const {
  const double r = k * suppressed_below_m / (2.0 * pi);
  const double r4 = r * r * r * r;
  return 1.0 - suppression_ * r4 / (1.0 + r4);
}

double Spectrum::operator()(glm::dvec2 k_xz) const {
  const double k = glm::length(k_xz);
  if (!(k > 0.0)) return 0.0;
  const double w = frequency(k);
  const double to = std::atan2(k_xz.x, -k_xz.y);  // clockwise from -z
  double density = 0.0;
  if (wind_.alpha > 0.0)
    density += frequency_density(wind_, gravity_, w) * wind_spreading(angle_between(to, wind_.to_rad), w / wind_.peak_rad_s);
  if (swell_.alpha > 0.0)
    density += frequency_density(swell_, gravity_, w) * swell_spreading(angle_between(to, swell_.to_rad));
  // dw dtheta = (dw/dk) / k dkx dkz with dw/dk = w / 2k.
  return density * w / (2.0 * k * k) * suppression(k);
}

}  // namespace seascape
