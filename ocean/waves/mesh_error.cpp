#include "ocean/waves/mesh_error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace seascape {

namespace {
// The share of a wave's variance that a mesh misses, over wave number times spacing: where it is small, vertices are
// joined straight across a crest, an error as its square; a wave shorter than two vertices is missed whole and turns up
// as another besides. Both fitted to the wave field's own meshes (docs/accuracy.md).
constexpr double half_missed = 2.6, most_missed = 1.5;
// From the root mean square, which the above overrates by a tenth, to the largest of some million points: of meshes so
// fine that all of their waves are short, and of coarser ones, which also miss crests that are sharp because long and
// short waves' crests meet there.
constexpr double fine_m = 4.0, fine_peak = 5.36, coarse_m = 16.0, coarse_peak = 6.4;
double peak(double spacing_m) {
  const double t = std::clamp(std::log(spacing_m / fine_m) / std::log(coarse_m / fine_m), 0.0, 1.0);
  return std::lerp(fine_peak, coarse_peak, t);
}

// Where a value lies between 1, 2, 4, ...: from which of them on, of `last` and none beyond, and how far towards the
// next, in proportion.
struct Octave {
  std::size_t n;
  double share;
};
Octave octave(double value, std::size_t last) {
  if (!(value > 1.0)) return {0, 0.0};
  // Of a double above 1: its exponent, and its fraction.
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::size_t n = (bits >> 52) - 1023;
  return n < last ? Octave{n, std::bit_cast<double>((bits & 0xfffffffffffffu) | 0x3ff0000000000000u) - 1.0}
                  : Octave{last - 1, 1.0};
}
}  // namespace

double largest_of_missed(double spacing_m, double rms_m) { return peak(spacing_m) * rms_m; }

double VarianceByLength::wave_number(int bucket) { return least_wave_number * std::exp2((bucket + 0.5) / per_octave); }

void VarianceByLength::add(double wave_number, double height_variance, double shift_variance) {
  if (!(height_variance > 0.0)) return;
  const int bucket =
      std::clamp(int(std::floor(std::log2(wave_number / least_wave_number) * per_octave)), 0, buckets - 1);
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
    result.octave_m[n] = largest_of_missed(spacing_m, std::sqrt(missed));
  }
  return result;
}

// Water a distance r away moves against a place, of a wave of all directions, by 2 (1 - J0(k r)) of its variance: (k
// r)^2 / 2 at first, at most 2.8. Smoothing leaves out what is shorter than some footprints, which counts besides.
NearMotion VarianceByLength::near_motion(double chop) const {
  NearMotion result;
  for (std::size_t n = 0; n < result.vertical_m.size(); ++n) {
    double height = 0.0, shift = 0.0;
    for (int b = 0; b < buckets; ++b) {
      const double k = wave_number(b), r = k * NearMotion::least_distance_m * std::exp2(double(n)),
                   f = k * NearMotion::footprint_m;
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
  const auto [n, share] = octave(distance_m * (1.0 / least_distance_m), vertical_m.size() - 1);
  const double of_octave = share * (1.344 - 0.344 * share);  // log2(1 + share), to a hundredth
  return glm::mix(glm::dvec2(vertical_m[n], horizontal_m[n]), glm::dvec2(vertical_m[n + 1], horizontal_m[n + 1]),
                  of_octave);
}

void NearMotion::add(double height_m, double chop) {
  for (double& deviation : vertical_m) deviation = std::hypot(deviation, height_m);
  for (double& deviation : horizontal_m) deviation = std::hypot(deviation, chop * height_m);
}

double MeshError::operator()(double spacing_m) const {
  const auto [n, share] = octave(spacing_m * (1.0 / least_spacing_m), octave_m.size() - 1);
  return std::lerp(octave_m[n], octave_m[n + 1], share);
}

}  // namespace seascape
