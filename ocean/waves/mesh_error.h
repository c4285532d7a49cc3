// What follows from how a sea's variance is spread over wavelengths: what meshes of it miss, and how neighbouring water
// moves.
#pragma once
#include <array>

#include "ocean/waves/wave_field.h"

namespace seascape {

// The largest of some million points, in metres, of what meshes of `spacing_m` miss with a root mean square of `rms_m`
// of a sea of many waves.
double largest_of_missed(double spacing_m, double rms_m);

// Variances of height and shift (m^2) by quarters of an octave of the wave number.
class VarianceByLength {
 public:
  void add(double wave_number, double height_variance, double shift_variance);
  MeshError mesh_error() const;
  NearMotion near_motion(double chop) const;

 private:
  static constexpr int per_octave = 4, buckets = 26 * per_octave;
  static constexpr double least_wave_number = 1e-4;  // rad/m
  static double wave_number(int bucket);
  std::array<double, buckets> height_{}, shift_{};
};

}  // namespace seascape
