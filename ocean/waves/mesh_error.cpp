#include "ocean/waves/mesh_error.h"

#include <algorithm>
#include <cmath>

namespace seascape {

namespace {
// The share of a wave's variance that a mesh misses, over wave number times spacing: where it is small, vertices are joined
// straight across a crest, an error as its square; a wave shorter than two vertices is missed whole and turns up as another besides.
// Both fitted to the wave field's own meshes (docs/accuracy.md).
constexpr double half_missed = 2.6, most_missed = 1.5;
// From the root mean square, which the above overrates by a tenth, to the largest of some million points: of meshes so fine that all of their waves are short,
// and of coarser ones, which also miss crests that are sharp because long and short waves' crests meet there.
constexpr double fine_m = 4.0, fine_peak = 5.2, coarse_m = 16.0, coarse_peak = 5.8;
double peak(double spacing_m) {
  const double t = std::clamp(std::log(spacing_m / fine_m) / std::log(coarse_m / fine_m), 0.0, 1.0);
  return std::lerp(fine_peak, coarse_peak, t);
}
}  // namespace

double VarianceByLength::wave_number(int bucket) { return least_wave_number * std::exp2((bucket + 0.5) / per_octave); }

void VarianceByLength::add(double wave_number, double height_variance, double shift_variance) {
  if (!(height_variance > 0.0)) return;
  const int bucket = std::clamp(int(std::floor(std::log2(wave_number / least_wave_number) * per_octave)), 0, buckets - 1);
  height_[std::size_t(bucket)] += height_variance;
  shift_[std::size_t(bucket)] += shift_variance;
}

MeshError VarianceByLength::mesh_error() const {
  MeshError result;
  for (std::size_t n = 0; n < result.octave_m.size(); ++n) {
    const double spacing_m = MeshError::least_spacing_m * std::exp2(double(n));
    double missed = 0.0;
    for (int b = 0; b < buckets; ++b) {
      const double t = wave_number(b) * spacing_m / half_missed, t4 = t * t * t * t;
      missed += height_[std::size_t(b)] * most_missed * t4 / (most_missed + t4);
    }
    result.octave_m[n] = peak(spacing_m) * std::sqrt(missed);
  }
  return result;
}

// Water a distance r away moves against a place, of a wave of all directions, by 2 (1 - J0(k r)) of its variance: (k r)^2 / 2 at first,
// at most 2.8. Smoothing leaves out what is shorter than some footprints, which counts besides.
NearMotion VarianceByLength::near_motion(double chop) const {
  NearMotion result;
  for (std::size_t n = 0; n < result.vertical_m.size(); ++n) {
    double height = 0.0, shift = 0.0;
    for (int b = 0; b < buckets; ++b) {
      const double k = wave_number(b), r = k * NearMotion::least_distance_m * std::exp2(double(n)), f = k * NearMotion::footprint_m;
      const double smoothed = std::min(f * f / 8.0, 1.0);
      const double share = std::min(0.5 * r * r, 2.8) * (1.0 - smoothed) + smoothed * smoothed;
      height += share * height_[std::size_t(b)];
      shift += share * shift_[std::size_t(b)];
    }
    result.vertical_m[n] = std::sqrt(height);
    result.horizontal_m[n] = chop * std::sqrt(shift);
  }
  return result;
}

glm::dvec2 NearMotion::operator()(double distance_m) const {
  const double at = std::clamp(std::log2(distance_m / least_distance_m), 0.0, double(vertical_m.size() - 1));
  const auto n = std::min(std::size_t(at), vertical_m.size() - 2);
  return glm::mix(glm::dvec2(vertical_m[n], horizontal_m[n]), glm::dvec2(vertical_m[n + 1], horizontal_m[n + 1]), at - double(n));
}

void MeshError::doubling(double spacing_m, std::span<double> errors_m) const {
  const double at = std::clamp(std::log2(spacing_m / least_spacing_m), -100.0, 100.0), below = std::floor(at), share = std::exp2(at - below) - 1.0;
  const auto last = static_cast<std::ptrdiff_t>(octave_m.size()) - 1;
  auto n = static_cast<std::ptrdiff_t>(below);
  for (double& error_m : errors_m) {
    error_m = n < 0 ? octave_m.front() : n >= last ? octave_m.back() : std::lerp(octave_m[std::size_t(n)], octave_m[std::size_t(n) + 1], share);
    ++n;
  }
}

double MeshError::operator()(double spacing_m) const {
  const double at = std::clamp(std::log2(spacing_m / least_spacing_m), 0.0, double(octave_m.size() - 1));
  const auto n = std::min(std::size_t(at), octave_m.size() - 2);
  return std::lerp(octave_m[n], octave_m[n + 1], std::exp2(at - double(n)) - 1.0);
}

}  // namespace seascape
