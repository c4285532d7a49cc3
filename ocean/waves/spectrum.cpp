#include "ocean/waves/spectrum.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/dispersion.h"

namespace seascape {

namespace {
constexpr double pi = std::numbers::pi;
constexpr double suppressed_below_m = 2.0;
constexpr double short_from_m = 12.0, short_from_peaks = 10.0;
constexpr double short_to_m = 0.3, short_to_ratio = 4.0;

double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}
}  // namespace

double longest_peak_wave_m(const SeaState& sea) {
  validate(sea);
  double longest = 0.0;
  const auto ask = [&](const WaveTrain& train) {
    if (train.alpha > 0.0)
      longest = std::max(longest, 2.0 * pi / airy_wave_number(train.peak_rad_s, sea.gravity_mps2, sea.depth_m));
  };
  ask(wind_train(sea));
  for (const WaveTrain& train : swell_of(sea)) ask(train);
  return longest;
}

Spectrum::Spectrum(const SeaState& sea)
    : spectrum_(sea.spectrum),
      spreading_(sea.spreading),
      elongation_(sea.swell_elongation),
      gravity_(sea.gravity_mps2),
      depth_(sea.depth_m),
      suppression_(sea.small_wave_suppression),
      wind_share_(sea.wind_height_share * sea.wind_height_share) {
  validate(sea);
  wind_ = wind_train(sea);
  swell_ = swell_of(sea);
  if (wind_.alpha == 0.0) return;
  inverse_wave_age_ = sea.wind_speed_mps * wind_.peak_rad_s / gravity_;
  short_waves_ = Elfouhaily(sea.wind_speed_mps, inverse_wave_age_, gravity_);
  const double peak = wind_.peak_rad_s * wind_.peak_rad_s / gravity_;
  short_from_ = std::max(2.0 * pi / short_from_m, short_from_peaks * peak);
  short_to_ = std::max(2.0 * pi / short_to_m, short_to_ratio * short_from_);
}

bool Spectrum::flat() const {
  for (int i = 0; i < components; ++i)
    if (present(i)) return false;
  return true;
}

double Spectrum::frequency(double k) const { return wave_frequency(k, gravity_, depth_); }

double Spectrum::suppression(double k) const {
  const double r = k * suppressed_below_m / (2.0 * pi);
  const double r4 = std::min(r * r * r * r, 1e300);
  return 1.0 - suppression_ * r4 / (1.0 + r4);
}

double Spectrum::short_share(double deep_k) const {
  if (deep_k <= short_from_) return 0.0;
  return smooth_step(std::log(deep_k / short_from_) / std::log(short_to_ / short_from_));
}

double Spectrum::over_peak(const WaveTrain& train, double k) const {
  return airy_frequency(k, gravity_, depth_) / train.peak_rad_s;
}

double Spectrum::radial(int component, double k) const {
  if (!(k > 0.0) || !present(component)) return 0.0;
  // Spectra over frequency are of gravity waves, and so is their way to wave numbers: S(k) = S(w) dw/dk.
  const double w = airy_frequency(k, gravity_, depth_), deep_k = w * w / gravity_;
  double density = 0.0;
  if (component >= 2) {
    density = frequency_density(train(component), gravity_, w) * airy_group_speed(k, gravity_, depth_);
  } else {
    const double share = short_share(deep_k), mine = component == 1 ? share : 1.0 - share;
    if (mine == 0.0) return 0.0;
    if (component == 1 || spectrum_ == WaveSpectrum::elfouhaily) {
      density = mine * (component == 1 ? short_waves_.tail_curvature(deep_k) : short_waves_.curvature(deep_k));
      if (density == 0.0) return 0.0;  // the cube of k may be less than any double
      density /= k * k * k;
    } else
      density = mine * frequency_density(wind_, gravity_, w) * airy_group_speed(k, gravity_, depth_);
    if (component == 0 && spectrum_ == WaveSpectrum::tma) density *= kitaigorodskii_factor(w, gravity_, depth_);
  }
  return density / k * suppression(k) * (component < 2 ? wind_share_ : 1.0);
}

SpreadingShape Spectrum::shape(int component, double k) const {
  const double r = over_peak(train(component), k);
  if (component >= 2) return swell_spreading(r, elongation_);
  const WaveSpreading model = component == 1 ? WaveSpreading::elfouhaily : spreading_;
  const double delta = model == WaveSpreading::elfouhaily ? short_waves_.delta(k) : 0.0;
  return wind_spreading(model, r, inverse_wave_age_, delta, elongation_);
}

double Spectrum::operator()(glm::dvec2 k_xz) const {
  const double k = glm::length(k_xz), to = std::atan2(k_xz.x, -k_xz.y);  // clockwise from -z
  double density = 0.0;
  for (int i = 0; i < components; ++i) {
    const double r = radial(i, k);
    if (r > 0.0) density += r * spreading(shape(i, k), to - to_rad(i));
  }
  return density;
}

glm::dvec3 slope_moments(const SeaState& sea) {
  SeaState whole = sea;
  whole.small_wave_suppression = 0.0;
  const Spectrum spectrum(whole);
  // From waves of 60 km to capillaries of a quarter of a millimetre; smooth over ln k, so trapezoids do. A spreading
  // varies slowly: its moment is asked for at every tenth node and taken along a straight line between.
  constexpr double from = 1e-4, to = 2.5e4, step = 0.02;
  constexpr int coarse = 10;
  const int rows = int(std::log(to / from) / (step * coarse));
  glm::dvec3 sum(0.0);
  for (int c = 0; c < Spectrum::components; ++c) {
    if (!spectrum.present(c)) continue;
    const double angle = 2.0 * spectrum.to_rad(c);
    const auto moment = [&](int row) { return second_moment(spectrum.shape(c, from * std::exp(step * coarse * row))); };
    double along = 0.0, isotropic = 0.0, here = 0.0, next = 0.0;
    int known = -1;  // the row that `next` belongs to
    for (int row = 0; row < rows; ++row)
      for (int i = 0; i < coarse; ++i) {
        const double k = from * std::exp(step * (row * coarse + i)),
                     variance = step * k * k * k * k * spectrum.radial(c, k);
        if (variance == 0.0) continue;
        if (known != row + 1) {
          here = known == row ? next : moment(row);
          next = moment(known = row + 1);
        }
        isotropic += 0.5 * variance;
        along += 0.5 * variance * (here + (next - here) * i / coarse);
      }
    // E[hx^2] = variance (1 - moment cos 2 to) / 2 since x = sin(to), z = -cos(to).
    sum +=
        glm::dvec3(isotropic - along * std::cos(angle), isotropic + along * std::cos(angle), -along * std::sin(angle));
  }
  return sum;
}

}  // namespace seascape
