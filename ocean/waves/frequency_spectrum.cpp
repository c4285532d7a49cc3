#include "ocean/waves/frequency_spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/elfouhaily.h"

namespace seascape {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double swell_gamma = 6.0;
constexpr double u19_over_u10 = 1.026;               // Pierson and Moskowitz measured at 19.5 m
constexpr double pm_alpha = 0.0081, pm_beta = 0.74;  // Pierson and Moskowitz (1964)
constexpr double fade_from = 10.0, fade_to = 40.0;   // of swell, over (w / wp)^2

// m0 wp^4 / (alpha g^2) of a train's shape: 1/5 for gamma 1. Trapezoids over s = ln(w/wp), which converge exponentially
// for this smooth, decaying integrand apart from the small kink of sigma at the peak, which is a node.
double shape_integral(double gamma, bool fades) {
  constexpr int nodes_below = 300, nodes_above = 1200;
  constexpr double step = 0.005;
  double sum = 0.0;
  const WaveTrain unit{1.0, 1.0, gamma, 0.0, fades};
  for (int i = -nodes_below; i <= nodes_above; ++i) {
    const double w = std::exp(i * step);
    sum += frequency_density(unit, 1.0, w) * w;
  }
  return sum * step;
}

WaveTrain swell_train(const SeaState& sea, double height_m, double period_s, double to_deg) {
  WaveTrain train;
  train.gamma = swell_gamma;
  train.fades = true;
  train.to_rad = to_deg * pi / 180.0;
  train.peak_rad_s = 2.0 * pi / period_s;
  if (!(height_m > 0.0) || !(sea.depth_m > 0.0)) return train;
  // Every train has this shape: its integral is made once.
  static const double shape = shape_integral(swell_gamma, true);
  const double p = train.peak_rad_s, g = sea.gravity_mps2;
  train.alpha = height_m * height_m / 16.0 * p * p * p * p / (g * g * shape);
  return train;
}
}  // namespace

double frequency_density(const WaveTrain& train, double gravity_mps2, double w) {
  if (train.alpha == 0.0 || !(w > 0.0)) return 0.0;
  const double ratio = train.peak_rad_s / w, r2 = ratio * ratio, r4 = r2 * r2;
  if (1.25 * r4 > 700.0) return 0.0;
  double kept = 1.0;
  if (train.fades && r2 * fade_from < 1.0) {
    if (r2 * fade_to <= 1.0) return 0.0;
    const double t = -std::log(r2 * fade_from) / std::log(fade_to / fade_from);
    kept = 1.0 - t * t * (3.0 - 2.0 * t);
  }
  const double sigma = w <= train.peak_rad_s ? 0.07 : 0.09;
  const double d = (w / train.peak_rad_s - 1.0) / sigma;
  const double w5 = w * w * w * w * w;
  return kept * train.alpha * gravity_mps2 * gravity_mps2 / w5 *
         std::exp(-1.25 * r4 + std::log(train.gamma) * std::exp(-0.5 * d * d));
}

double kitaigorodskii_factor(double w, double gravity_mps2, double depth_m) {
  if (!(depth_m > 0.0)) return 0.0;
  const double wh = w * std::sqrt(depth_m / gravity_mps2);
  if (wh >= 2.0) return 1.0;
  return wh <= 1.0 ? 0.5 * wh * wh : 1.0 - 0.5 * (2.0 - wh) * (2.0 - wh);
}

WaveTrain wind_train(const SeaState& sea) {
  WaveTrain train;
  train.to_rad = sea.wind_to_deg * pi / 180.0;
  train.gamma = sea.spectrum == WaveSpectrum::pierson_moskowitz ? 1.0 : sea.peak_enhancement;
  const double g = sea.gravity_mps2, u = sea.wind_speed_mps;
  const double x = u > 0.0 ? g * sea.fetch_m / (u * u) : 0.0;
  // Below these the waves would be shorter than a hundredth of a millimetre: flat, and nothing overflows.
  if (u < 1e-3 || x < 1e-6 || !(sea.depth_m > 0.0)) return train;
  const double u19 = u19_over_u10 * u;
  const double developed_peak = std::pow(0.8 * pm_beta, 0.25) * g / u19;
  if (sea.spectrum == WaveSpectrum::elfouhaily) {
    const double age = inverse_wave_age(x);
    train.peak_rad_s = age * g / u;
    train.alpha = 6e-3 * std::sqrt(age);
    return train;
  }
  if (sea.spectrum == WaveSpectrum::pierson_moskowitz) {
    train.peak_rad_s = developed_peak;
    train.alpha = pm_alpha;
    return train;
  }
  // Past the fetch at which the peak is fully developed the sea grows no more: alpha, which falls with fetch, is held
  // too.
  const double developed_root = 22.0 * (g / u) / developed_peak;
  const double grown = std::min(x, developed_root * developed_root * developed_root);
  train.peak_rad_s = 22.0 * (g / u) * std::pow(grown, -1.0 / 3.0);
  const double developed_variance = pm_alpha * u19 * u19 * u19 * u19 / (4.0 * pm_beta * g * g);
  const double p = train.peak_rad_s;
  const double most = developed_variance * p * p * p * p / (g * g * shape_integral(train.gamma, false));
  train.alpha = std::min(0.076 * std::pow(grown, -0.22), most);
  return train;
}

std::array<WaveTrain, swell_trains> swell_of(const SeaState& sea) {
  return {swell_train(sea, sea.swell_height_m, sea.swell_period_s, sea.swell_to_deg),
          swell_train(sea, sea.swell2_height_m, sea.swell2_period_s, sea.swell2_to_deg),
          swell_train(sea, sea.swell3_height_m, sea.swell3_period_s, sea.swell3_to_deg)};
}

}  // namespace seascape
