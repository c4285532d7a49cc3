// What waves along curves do to a row of texels, vectorised: what the two patterns that a current carries add to the
// water, without the slopes of heights.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ocean/places/flow_phase.h"

namespace seascape {

// One mip level of the curves' tile.
struct ShoreLevel {
  const glm::vec4 *shift, *slope, *moments;  // its first texels
  std::int32_t mask, stride;                 // size - 1; texels from one row to the next
  float cosine, sine, first;                 // from the pattern (m) to texels; the texel at its origin
  float share;                               // of what is read here that counts
};
struct ShorePattern {
  ShoreLevel levels[2];
  int count = 0;           // none: the footprint has taken it all
  float size;              // what displacements are to be multiplied with
  float kept;              // share of the waves that the footprint keeps
  float whole_moment;      // of the divergence
  glm::vec3 decay_per_m2;  // of the pattern (flow_height)
  float least_flow_mps;    // slower, water stands
};

// Where a texel lies along the curves, and what they bring it.
struct ShoreTexelPlace {
  glm::vec4 place{0.0f};  // in the pattern (m, x within a period), and the way along the curve
  glm::vec4 waves{0.0f};  // stretch, turning (1/m), share, surf
};

inline constexpr int shore_group = 16;

// What comes of it at a texel.
struct ShoreMoved {
  float x, y, z;     // m
  float xx, zz, xz;  // dDx/dx, dDz/dz, dDx/dz
  float variance;    // of the divergence, within the texel
};

// Of shore_group texels. `flow`: their water's velocity (m/s); null: it stands. All instruction sets give the same
// bits.
void shore_moved(const ShorePattern& pattern, const FlowPhase& phase, const ShoreTexelPlace* texels,
                 const glm::vec2* flow, ShoreMoved* moved);

}  // namespace seascape
