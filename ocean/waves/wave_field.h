// The sea on the CPU: every deterministic wave at any time, on any thread, with no GPU. The same bins, tiles, mip chain and
// sampling as the compute shaders.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ocean/waves/ladder.h"
#include "ocean/waves/sea_state.h"
#include "shaders/shared/wave_bin.h"

namespace seascape {

// All waves of a sea at a quality: one table of wave_bins^2 a cascade, cascade after cascade.
struct WaveBins {
  Ladder ladder;
  int cascades = 0;
  std::vector<gpu::WaveBin> bins;
};

// Bins whose |m| reaches resolution / 2 are left out (a 16^2 tile keeps |m| < 8); a kept bin never depends on the quality.
WaveBins make_wave_bins(const SeaState& sea, const WaveQuality& quality);

std::int64_t ticks_from_seconds(double time_s);

// Sums over the drawn bins: what the surface's statistics must come to. Variances in m^2 and (dimensionless) slope^2.
struct SeaStatistics {
  double height_variance = 0.0;        // Hs = 4 sqrt of it
  glm::dvec3 slope_moments{0.0};       // E[hx^2], E[hz^2], E[hx hz] of the drawn waves
  glm::dvec3 tail_slope_moments{0.0};  // of the waves too short to be drawn: the rest up to Cox and Munk (1954)
  double largest_height_m = 0.0;       // a bound for culling: 99.9999 % of crests, chop included
  double largest_shift_m = 0.0;        // the same for horizontal displacement
};
SeaStatistics sea_statistics(const SeaState& sea, const WaveBins& bins);

// Displacement, derivatives and their mip chains of each cascade at one time. Planes are [cascade][level][z][x].
class WaveTiles;  // ocean/waves/wave_tiles.h

// The surface at one rest position.
struct SeaSample {
  glm::dvec3 displacement{0.0};  // metres, to add to (x, 0, z)
  glm::dvec2 height_gradient{0.0};     // dh/dx, dh/dz over the rest position
  glm::dvec3 shift_gradient{0.0};      // dDx/dx, dDz/dz, dDx/dz (= dDz/dx)
  glm::dvec3 slope_moments{0.0};       // unresolved E[s^2] below the footprint: xx, zz, xz
  glm::dvec2 slope() const;      // of the displaced surface: inverse transpose of (I + grad D) times height_gradient
  double jacobian() const;       // det(I + grad D): 1 at rest, below 0 where the surface folds
};

}  // namespace seascape
