#include "ocean/waves/sea_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/dispersion.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_particles.h"

namespace seascape {

namespace {
constexpr double longest_k = 1e-4, shortest_m = 0.1;
constexpr double least_left = 0.125;  // of the steepness that water bears
// Variance of the gradient by which the displacement draws the water together.
const double most_drawn = std::pow(0.142 * std::numbers::pi, 2.0) / (2.0 * std::numbers::ln10);

struct Variances {
  double height_m2 = 0.0, drawn = 0.0;
};

// Of the components `first` to `end` - 1 of a spectrum. Trapezoids over ln k: narrow swells are some ten steps wide.
Variances variances_of(const Spectrum& spectrum, double depth_m, int first, int end) {
  constexpr double step = 0.02;
  const double to = std::log(2.0 * std::numbers::pi / shortest_m);
  Variances sum;
  for (double ln_k = std::log(longest_k); ln_k < to; ln_k += step) {
    const double k = std::exp(ln_k), orbit = k * orbit_width(k, depth_m);
    double density = 0.0;
    for (int component = first; component < end; ++component)
      if (spectrum.present(component)) density += spectrum.radial(component, k);
    sum.height_m2 += step * k * k * density;
    sum.drawn += step * k * k * density * orbit * orbit;
  }
  return sum;
}
}  // namespace

LimitedSea limited_sea(const SeaState& sea, const std::optional<WaveParticleSettings>& particles) {
  constexpr int wind = LimitedSea::wind, first_swell = LimitedSea::first_swell, last = LimitedSea::of_particles;
  const Spectrum spectrum(sea);
  std::array<Variances, last + 1> parts;
  parts[wind] = variances_of(spectrum, sea.depth_m, 0, 2);
  for (int train = 0; train < swell_trains; ++train)
    parts[std::size_t(first_swell + train)] = variances_of(spectrum, sea.depth_m, 2 + train, 3 + train);
  if (particles) {
    validate(*particles);
    parts[last] = {particles->height_m * particles->height_m / 16.0, drawn_together(*particles)};
  }

  LimitedSea result{sea, particles, {}};
  std::array<double, last + 1> share;  // of the variances
  share.fill(1.0);
  const auto limit = [&](int i, double to, bool LimitedSea::Waves::*why) {
    if (!(to < 1.0)) return;
    share[std::size_t(i)] *= to;
    result.waves[std::size_t(i)].*why = true;
  };
  const auto drawn = [&](int i) { return share[std::size_t(i)] * parts[std::size_t(i)].drawn; };
  const double height_m = most_height_of_depth * std::max(sea.depth_m, 0.0) / 4.0, most_m2 = height_m * height_m;
  for (int i = 0; i <= last; ++i)
    if (parts[std::size_t(i)].height_m2 > 0.0)
      limit(i, most_m2 / parts[std::size_t(i)].height_m2, &LimitedSea::Waves::too_high);

  const double left = std::max(most_drawn - drawn(wind), least_left * most_drawn);
  double swell = 0.0;
  for (int i = first_swell; i < last; ++i) {
    if (drawn(i) > 0.0) limit(i, left / drawn(i), &LimitedSea::Waves::too_steep);
    swell += drawn(i);
  }
  for (int i = first_swell; i < last; ++i)
    if (drawn(i) > 0.0) limit(i, left / swell, &LimitedSea::Waves::too_steep);
  const double left_by_swell = std::max(most_drawn - std::min(swell, left), least_left * most_drawn);
  if (drawn(last) > 0.0) limit(last, left_by_swell / drawn(last), &LimitedSea::Waves::too_steep);

  double all_m2 = 0.0;
  for (int i = 0; i <= last; ++i) all_m2 += share[std::size_t(i)] * parts[std::size_t(i)].height_m2;
  for (int i = 0; all_m2 > 0.0 && i <= last; ++i)
    if (parts[std::size_t(i)].height_m2 > 0.0) limit(i, most_m2 / all_m2, &LimitedSea::Waves::too_high);

  const std::array<double*, 3> swells{&result.sea.swell_height_m, &result.sea.swell2_height_m,
                                      &result.sea.swell3_height_m};
  for (int i = 0; i <= last; ++i) {
    LimitedSea::Waves& waves = result.waves[std::size_t(i)];
    const double kept = std::sqrt(share[std::size_t(i)]);
    if (i == wind) {
      waves.asked_m = 4.0 * std::sqrt(parts[wind].height_m2);
      result.sea.wind_height_share *= kept;
    } else if (i < last) {
      waves.asked_m = *swells[std::size_t(i - first_swell)];
      *swells[std::size_t(i - first_swell)] *= kept;
    } else if (particles) {
      waves.asked_m = particles->height_m;
      result.particles->height_m *= kept;
    }
    waves.drawn_m = kept * waves.asked_m;
  }
  return result;
}

}  // namespace seascape
