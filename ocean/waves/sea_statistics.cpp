// Sums over the waves of a sea: its statistics and the bounds of its displacement.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

namespace {
// Mean square slopes up and across the wind of a clean sea (Cox and Munk 1954), the constant of the crosswind line
// brought to zero with the last metre per second of wind, so that no wind has no slopes.
glm::dvec2 cox_munk(double wind_mps) { return {0.00316 * wind_mps, 0.003 * std::min(1.0, wind_mps) + 0.00192 * wind_mps}; }

constexpr double crest_deviations = 5.26;  // Rayleigh: exp(-c^2 / 2) = 1e-6
constexpr double least_tail = 0.05;        // share of Cox and Munk's variance that the drawn waves never use up
}  // namespace

SeaStatistics sea_statistics(const SeaState& sea, const WaveBins& bins) {
  validate(sea);
  SeaStatistics result;
  constexpr int n = gpu::wave_bins;
  double sum_of_amplitudes = 0.0;
  for (int index = 0; index < bins.cascades; ++index) {
    const Cascade& cascade = bins.ladder[index];
    const double step = 2.0 * std::numbers::pi / cascade.side_m;
    for (int mz = -n / 2; mz < n / 2; ++mz)
      for (int mx = -n / 2; mx < n / 2; ++mx) {
        const glm::dvec2 a(bins.bins[(std::size_t(index) * n + mz + n / 2) * n + mx + n / 2].amplitude);
        const double variance = 0.5 * glm::dot(a, a);
        const glm::dvec2 k = step * rotate_xz({mx, mz}, cascade.rotation_rad);
        result.height_variance += variance;
        result.slope_moments += variance * glm::dvec3(k.x * k.x, k.y * k.y, k.x * k.y);
        sum_of_amplitudes += glm::length(a);
      }
  }

  const glm::dvec2 along = direction_xz(sea.wind_to_deg), across{-along.y, along.x};
  const auto drawn_towards = [&](glm::dvec2 d) {
    const glm::dvec3& s = result.slope_moments;
    return d.x * d.x * s.x + d.y * d.y * s.y + 2.0 * d.x * d.y * s.z;
  };
  const glm::dvec2 whole = cox_munk(sea.wind_speed_mps);
  const double keep = 1.0 - 0.9 * sea.small_wave_suppression;
  const double up = keep * std::max(whole.x - drawn_towards(along), least_tail * whole.x);
  const double cross = keep * std::max(whole.y - drawn_towards(across), least_tail * whole.y);
  result.tail_slope_moments = {up * along.x * along.x + cross * across.x * across.x,
                               up * along.y * along.y + cross * across.y * across.y,
                               up * along.x * along.y + cross * across.x * across.y};

  // The sum of all amplitudes is never passed; for a sea of many waves the Rayleigh bound is far below it.
  result.largest_height_m = std::min(crest_deviations * std::sqrt(result.height_variance), sum_of_amplitudes);
  result.largest_shift_m = sea.chop * result.largest_height_m;
  return result;
}

}  // namespace seascape
