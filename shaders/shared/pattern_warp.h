// How the longest tile's pattern is laid in a light sea: warped by a few long waves of shift, so that copies of the
// tile are unlike each other (ocean/waves/pattern_warp.h). Shared by C++ and GLSL.
#ifndef SEASCAPE_PATTERN_WARP_H
#define SEASCAPE_PATTERN_WARP_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::floor;
using glm::min;
#endif

SEASCAPE_CONST int warp_waves = 4;

// A pattern is taken at the rest position and the sum of these waves' shifts.
struct WarpData {
  vec4 wave[warp_waves];  // x, y: wave vector along x and z, turns a metre; z, w: how far it shifts along x and z, m
  vec4 phase;             // of each wave at the grid origin, turns
};

// A wave's phase at a place, times 2^32 of a turn (cos_sin_turns).
SEASCAPE_REAL_FUNCTION uint warp_turns(Real along_x, Real along_z, Real phase, Real x, Real z) {
  Real turns = along_x * x + along_z * z + phase;
  // What floats make a whole turn of counts as a little less.
  return uint(min(turns - floor(turns), Real(0.99999994)) * Real(4294967296.0));
}

// What a wave's shift along one axis grows by in a metre along another.
SEASCAPE_REAL_FUNCTION Real warp_growth(Real shift, Real along, Real cosine) {
  return Real(6.283185307179586) * shift * along * cosine;
}

SEASCAPE_SHARED_END
#endif
