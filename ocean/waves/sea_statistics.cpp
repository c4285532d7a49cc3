// Sums over the waves of a sea: its statistics and the bounds of its displacement.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "ocean/waves/dispersion.h"
#include "ocean/waves/mesh_error.h"
#include "ocean/waves/spectrum.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

namespace {
constexpr double crest_deviations = 5.26;  // Rayleigh: exp(-c^2 / 2) = 1e-6
constexpr double least_tail = 0.05;        // share of the whole spectrum's slopes that the drawn waves never use up
}  // namespace

SeaStatistics sea_statistics(const SeaState& sea, const WaveBins& bins) {
  validate(sea);
  SeaStatistics result;
  double sum_of_amplitudes = 0.0, shift_variance = 0.0, sum_of_shifts = 0.0;  // shifts of chop 1
  VarianceByLength by_length;
  for (int index = 0; index < bins.cascades; ++index) {
    const Cascade& cascade = bins.ladder[index];
    const double step = 2.0 * std::numbers::pi / cascade.side_m;
    const double cosine = std::cos(cascade.rotation_rad), sine = std::sin(cascade.rotation_rad);
    const int n = bins_of(index);
    for (int mz = -n / 2; mz < n / 2; ++mz)
      for (int mx = -n / 2; mx < n / 2; ++mx) {
        const glm::dvec2 a(bins.at(index, mx, mz).amplitude);
        const double variance = 0.5 * glm::dot(a, a);
        const glm::dvec2 k{step * (cosine * mx - sine * mz), step * (sine * mx + cosine * mz)};
        result.height_variance += variance;
        result.slope_moments += variance * glm::dvec3(k.x * k.x, k.y * k.y, k.x * k.y);
        sum_of_amplitudes += glm::length(a);
        const double width = variance > 0.0 ? orbit_width(glm::length(k), sea.depth_m) : 0.0;
        shift_variance += variance * width * width;
        by_length.add(glm::length(k), variance, variance * width * width);
        sum_of_shifts += glm::length(a) * width;
      }
  }

  result.mesh_error = by_length.mesh_error();
  result.near_motion = by_length.near_motion(sea.chop);

  const glm::dvec2 along = direction_xz(sea.wind_to_deg), across{-along.y, along.x};
  const auto towards = [](const glm::dvec3& s, glm::dvec2 d) {
    return d.x * d.x * s.x + d.y * d.y * s.y + 2.0 * d.x * d.y * s.z;
  };
  // What is drawn and what is left come to the whole spectrum's slopes, in the wind's own axes.
  const glm::dvec3 whole = slope_moments(sea);
  const double keep = 1.0 - 0.9 * sea.small_wave_suppression;
  const auto rest = [&](glm::dvec2 d) {
    return keep * std::max(towards(whole, d) - towards(result.slope_moments, d), least_tail * towards(whole, d));
  };
  const double up = rest(along), cross = rest(across);
  result.tail_slope_moments = {up * along.x * along.x + cross * across.x * across.x,
                               up * along.y * along.y + cross * across.y * across.y,
                               up * along.x * along.y + cross * across.x * across.y};

  // The sum of all amplitudes is never passed; for a sea of many waves the Rayleigh bound is far below it.
  result.largest_height_m = std::min(crest_deviations * std::sqrt(result.height_variance), sum_of_amplitudes);
  result.largest_shift_m = sea.chop * std::min(crest_deviations * std::sqrt(shift_variance), sum_of_shifts);
  return result;
}

}  // namespace seascape
