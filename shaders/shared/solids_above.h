// Where the pictures of what stands above the water have a direction: one looks upwards, four to the sides.
#ifndef SEASCAPE_SOLIDS_ABOVE_H
#define SEASCAPE_SOLIDS_ABOVE_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::vec3;
#endif

// In a row in one image: 0 looks up, 1 and 2 along x and against it, 3 and 4 along z and against it.
SEASCAPE_CONST int solids_above_sides = 5;
SEASCAPE_CONST float solids_above_near_m = 0.05f;
// Those to the sides see from so far below level, by its tangent, to 45 degrees above it.
SEASCAPE_CONST float solids_above_down = 0.35f;

// A direction (world axes) in a side's own: x to its right, y upwards, z ahead.
SEASCAPE_FUNCTION vec3 in_side_above(vec3 d, int side) {
  if (side == 1) return vec3(d.z, d.y, d.x);
  if (side == 2) return vec3(-d.z, d.y, -d.x);
  if (side == 3) return vec3(-d.x, d.y, d.z);
  if (side == 4) return vec3(d.x, d.y, -d.z);
  return vec3(d.x, d.z, d.y);
}

// In which side's picture a direction lies.
SEASCAPE_FUNCTION int side_above(vec3 d) {
  float x = d.x < 0.0f ? -d.x : d.x, z = d.z < 0.0f ? -d.z : d.z;
  if (d.y >= (x > z ? x : z)) return 0;
  if (x >= z) return d.x > 0.0f ? 1 : 2;
  return d.z > 0.0f ? 3 : 4;
}

// A side's clip space of a place from the pictures' middle, with reversed depth.
SEASCAPE_FUNCTION vec4 clip_above(vec3 place, int side) {
  vec3 own = in_side_above(place, side);
  float up = own.y;
  if (side > 0) up = (2.0f * own.y + (solids_above_down - 1.0f) * own.z) / (1.0f + solids_above_down);
  return vec4(own.x, -up, solids_above_near_m, own.z);
}

// That of the whole row.
SEASCAPE_FUNCTION vec4 clip_in_row_above(vec4 clip, int side) {
  float sides = float(solids_above_sides);
  return vec4((clip.x + (2.0f * float(side) + 1.0f - sides) * clip.w) / sides, clip.y, clip.z, clip.w);
}

SEASCAPE_SHARED_END
#endif
