// A level's surface from its waves, vectorised; DynamicSurface has a thread for each level.
#pragma once
#include <complex>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/waves/fft.h"

namespace seascape {

// What stays of a level's waves while its texels and its depth do, [mz + band/2][mx + band/2]. The first row and the
// first column are nobody's: their waves have no opposite.
struct LevelTable {
  std::vector<float> half;   // 0.5, or 0 where the level has no such wave
  std::vector<float> width;  // how far the water moves sideways, of its height, over its wave number, m
  std::vector<float> k;      // along an axis, of m + band/2, 1/m
};

// The waves at one time, and how much later the surface is wanted.
struct LevelWaves {
  std::span<const std::complex<double>> modes;
  std::span<const double> frequency;  // rad/s
  double damping_per_s, ahead_s;
};

// n^2 texels each, as DynamicSurface describes them; no velocity: null.
struct LevelPlanes {
  glm::vec4 *shift, *slope, *velocity;
};

struct LevelMost {
  float height_m, shift_m;        // nowhere more
  float squeeze;                  // minus the least eigenvalue of the shift's gradient, 0 or more
  float slope_step;               // between neighbouring texels: of what both slopes differ by, the norm (Frobenius)
  glm::dvec3 slope_moments{0.0};  // means of (dh/dx)^2, (dh/dz)^2, product
};

// One thread. The bits do not depend on the instruction set.
LevelMost fill_level(const FftPlan& plan, const LevelTable& table, const LevelWaves& waves, const LevelPlanes& planes);

}  // namespace seascape
