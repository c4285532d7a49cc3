#include "ocean/waves/spreading.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace seascape {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double swell_s = 25.0;
constexpr int most_values = 513;

// Angles from 0 to pi, what shapes ask of them, and their weights in an integral over a turn, [0, pi] being mirrored.
struct Angles {
  // Evenly spaced and of trapezoids; or, for integrals alone, ever closer towards pi (angle = pi (1 - v^2), v even),
  // where a cosine to a small power has no derivative, and of Simpson's weights.
  explicit Angles(int n, bool gathered = false) : count(n) {
    for (int i = 0; i < n; ++i) {
      const double even = double(i) / (n - 1), v = 1.0 - even;
      const double angle = gathered ? pi * (1.0 - v * v) : pi * even, c = std::cos(angle);
      const bool end = i == 0 || i == n - 1;
      weight[i] = gathered ? 4.0 * pi * v *
                                 (end          ? 1.0
                                  : i % 2 == 1 ? 4.0
                                               : 2.0) /
                                 (3.0 * (n - 1))
                           : (end ? 1.0 : 2.0) * pi / (n - 1);
      angle_rad[i] = angle;
      // At pi the cosine of half the angle is 0; s = 0 still has to give 1 there, and 0 times infinity would not.
      log_half_cosine2[i] = i == n - 1 ? -1e300 : std::log(0.5 * (1.0 + c));
      cos2[i] = std::cos(2.0 * angle);
      sense[i] = 1.0 + c * (15.0 - c * c * (10.0 - 3.0 * c * c)) / 8.0;
    }
  }
  int count;
  std::array<double, most_values> angle_rad, log_half_cosine2, cos2, sense, weight;
};

// Without its norm, `at` standing for one angle.
double raw(const SpreadingShape& shape, double angle, double log_half_cosine2, double cos2, double sense) {
  double exponent = shape.elongation, value = 1.0;
  switch (shape.form) {
    case SpreadingShape::Form::cosine_power:
      exponent += shape.parameter;
      break;
    case SpreadingShape::Form::sech_squared: {
      const double e = std::exp(-2.0 * shape.parameter * angle);
      value = 4.0 * e / ((1.0 + e) * (1.0 + e));
      break;
    }
    case SpreadingShape::Form::second_harmonic:
      value = std::max(0.0, (1.0 + shape.parameter * cos2) * sense);
      break;
  }
  return exponent > 0.0 ? value * std::exp(exponent * log_half_cosine2) : value;
}

void fill(const SpreadingShape& shape, const Angles& at, double* values) {
  for (int i = 0; i < at.count; ++i)
    values[i] = raw(shape, at.angle_rad[i], at.log_half_cosine2[i], at.cos2[i], at.sense[i]);
}

double integral(const Angles& at, const double* values) {
  double sum = 0.0;
  for (int i = 0; i < at.count; ++i) sum += at.weight[i] * values[i];
  return sum;
}

// For shapes whose integral has no closed form: within 1e-6.
const Angles& fine_angles() {
  static const Angles angles(most_values, true);
  return angles;
}

double norm(const SpreadingShape& shape) {
  using Form = SpreadingShape::Form;
  if (shape.form == Form::cosine_power) {
    const double s = shape.parameter + shape.elongation;
    return std::exp(std::lgamma(s + 1.0) - std::lgamma(s + 0.5)) / (2.0 * std::sqrt(pi));
  }
  if (shape.elongation <= 0.0 && shape.form == Form::sech_squared)
    return shape.parameter > 0.0 ? 0.5 * shape.parameter / std::tanh(shape.parameter * pi) : 0.5 / pi;
  if (shape.elongation <= 0.0) return 0.5 / pi;
  std::array<double, most_values> values;
  fill(shape, fine_angles(), values.data());
  return 1.0 / integral(fine_angles(), values.data());
}
}  // namespace

double spreading(const SpreadingShape& shape, double angle_rad) {
  const double angle = std::abs(std::remainder(angle_rad, 2.0 * pi)), c = std::cos(angle), half = 0.5 * (1.0 + c);
  const double sense = 1.0 + c * (15.0 - c * c * (10.0 - 3.0 * c * c)) / 8.0;
  return norm(shape) * raw(shape, angle, half > 0.0 ? std::log(half) : -1e300, std::cos(2.0 * angle), sense);
}

void tabulate_spreading(const SpreadingShape& shape, std::span<double> values) {
  const int n = int(values.size());
  assert(n >= 2 && n <= most_values);
  const auto make = [&](const Angles& at) {
    fill(shape, at, values.data());
    const double scale = 1.0 / integral(at, values.data());
    for (double& value : values) value *= scale;
  };
  static const Angles usual(129);  // the number that the tables of a sea use
  if (n == usual.count)
    make(usual);
  else
    make(Angles(n));
}

double second_moment(const SpreadingShape& shape) {
  if (shape.form == SpreadingShape::Form::second_harmonic && shape.elongation <= 0.0) return 0.5 * shape.parameter;
  std::array<double, most_values> values, moments;
  fill(shape, fine_angles(), values.data());
  for (int i = 0; i < most_values; ++i) moments[i] = values[i] * fine_angles().cos2[i];
  return integral(fine_angles(), moments.data()) / integral(fine_angles(), values.data());
}

SpreadingShape wind_spreading(WaveSpreading model, double w_over_peak, double inverse_wave_age, double delta,
                              double elongation) {
  using Form = SpreadingShape::Form;
  const double r = std::max(w_over_peak, 1e-3);
  SpreadingShape shape;
  shape.elongation = 16.0 * std::tanh(1.0 / r) * elongation * elongation;  // Horvath (2015), eq. 44
  switch (model) {
    case WaveSpreading::cosine_power:
      shape.parameter = 11.5 * std::pow(inverse_wave_age, -2.5) * std::pow(r, r <= 1.0 ? 5.0 : -2.5);
      break;
    case WaveSpreading::hasselmann:
      shape.parameter =
          r < 1.05 ? 6.97 * std::pow(r, 4.06) : 9.77 * std::pow(r, -2.33 - 1.45 * (inverse_wave_age - 1.17));
      break;
    case WaveSpreading::donelan_banner: {
      shape.form = Form::sech_squared;
      const double held = std::max(r, 0.56);
      if (held < 0.95)
        shape.parameter = 2.61 * std::pow(held, 1.3);
      else if (held < 1.6)
        shape.parameter = 2.28 * std::pow(held, -1.3);
      else
        shape.parameter = std::pow(10.0, -0.4 + 0.8393 * std::exp(-0.567 * 2.0 * std::log(held)));
      break;
    }
    case WaveSpreading::elfouhaily:
      shape.form = Form::second_harmonic;
      shape.parameter = delta;
      break;
  }
  return shape;
}

SpreadingShape swell_spreading(double w_over_peak, double elongation) {
  const double r = std::max(w_over_peak, 1e-3);
  return {SpreadingShape::Form::cosine_power, swell_s, 16.0 * std::tanh(1.0 / r) * elongation * elongation};
}

}  // namespace seascape
