// Where the waves break, for a row of texels at once: what Breaking makes of its readings, vectorised.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ocean/places/flow_phase.h"
#include "ocean/waves/wave_field.h"

namespace seascape {

// The warp of a row's texels.
struct WarpRow {
  struct Wave {
    double turns, step;  // its phase at the row's first texel, and from one to the next
    float way_x, way_z;  // how far it shifts, m
  };
  std::array<Wave, gpu::warp_waves> waves;
};

// A level of a place's tile, as a row's texels read it. Rows are read in groups, each from its own place in double:
// what floats take of it is the same a thousand kilometres out.
struct BreakingLayer {
  const glm::vec4 *slope, *shift;  // its first texels
  std::int32_t mask, stride;       // size - 1; texels from one row to the next
  double u, v;                     // of the row's first texel, in texels
  double step_u, step_v;           // from one of the row's texels to the next
  float cosine, sine;              // from the world to the tile, times texels a metre
  glm::vec3 decay_per_m2;          // of the pattern (flow_height)
  float share;                     // that counts
  const WarpRow* warp = nullptr;   // of its pattern; null: it lies straight
};

// What waves do besides, of each of a row's texels; null where nothing does. Water that nothing moves does not break.
struct BreakingWater {
  const float* kept = nullptr;  // the share of the waves' height that a bed leaves; null: all
  const float *flow_x = nullptr,
              *flow_z = nullptr;  // m/s, of a flow that carries the patterns along; both or none
  const float *xx = nullptr, *zz = nullptr, *xz = nullptr;  // to add: dDx/dx, dDz/dz, dDx/dz; all or none
  const float* variance = nullptr;                          // of the divergence, to add
  const float* sea_variance = nullptr;  // of the whole sea's divergence, to add: of waves that are as much a part of it
                                        // here as any; with `variance` or not at all
};

// A Jacobian's deviation is `thinner` times the divergence's and `least_sigma` more; its threshold `lowest` deviations
// of the sea's from 1, within the bounds.
struct BreakingLaw {
  float thinner, least_sigma, least_threshold, most_threshold;
  float lowest, threshold;  // of the sea alone
  float sea_variance;       // of the whole sea's divergence
  float variance;           // of it, what the layers leave out
  float least_flow_mps;     // slower, water stands
};

inline constexpr int breaking_group = 16;
inline constexpr int most_breaking_layers = WaveField::most_places;

// Adds per_s times the share of each texel that breaks; a multiple of breaking_group of them. The tail of the Gaussian
// is within 2e-6 of itself, and 0 beyond four deviations. All instruction sets give the same bits.
void breaking_row(std::span<const BreakingLayer> layers, const BreakingLaw& law, const BreakingWater& water,
                  const FlowPhase& phase, float per_s, std::span<float> gains);

}  // namespace seascape
