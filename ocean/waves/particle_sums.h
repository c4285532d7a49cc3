// The height of many wave particles on a torus, and how fast it changes, in the two ways of summing them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "ocean/waves/wave_particles_simd.h"

namespace seascape {

// What particles are summed on: `size` texels a side, on which they have `radius` texels.
struct ParticleGrid {
  int size;
  double radius;
};

// Texel by texel: exact to a float's rounding. Its time goes with the particles' number times their area.
class DirectSum {
 public:
  DirectSum(const ParticleGrid& grid, std::size_t count);
  std::size_t floats(bool velocity) const;
  // Fills the fields (rate.first null: without rates), in memory of floats(velocity).
  void sum(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float* memory,
           const TorusField& height, const TorusField& rate) const;

 private:
  int size_, strip_, strips_, blocks_;  // rows a strip, at least a particle's reach
  std::size_t count_;
  ParticleShape shape_;
};

// Splined onto the grid, four texels by four whatever the radius, and then all of them given their shape at once, by
// folding with taps that make it of splines (least squares). Its time hardly knows the particles' number; at a radius
// of four texels a shape is within 1 %.
class SplinedSum {
 public:
  SplinedSum(const ParticleGrid& grid, std::size_t count);
  std::size_t floats(bool velocity) const;
  void sum(std::span<const WaveParticle> particles, std::int64_t ticks, float amplitude, float* memory,
           const TorusField& height, const TorusField& rate) const;

 private:
  int size_, reach_, parts_;  // the particles are summed in so many parts, each by one thread
  std::vector<float> taps_;   // [row off][column off]
};

}  // namespace seascape
