// How far outwards each row of the horizon skirt lies, as a multiple of its distance from the tree's centre at row 0.
#ifndef SEASCAPE_SKIRT_H
#define SEASCAPE_SKIRT_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp; using glm::log; using glm::pow; using glm::round;
#endif

SEASCAPE_CONST float earth_radius_m = 6371000.0f;

// Exactly 1 at row 0, growing with every row, geometric so that the rows' spacing follows distance. `to_multiplier` (1 or
// more) is where the patches' density ends, `to_horizon` (above 1) how far the skirt must reach. A horizon inside the
// multiplier: every row goes to the multiplier. Beyond it: between a quarter and three quarters of the rows go to the
// multiplier and the others on to the horizon, shared by the logarithms of the two, so that from high above, where the
// horizon is many times farther, the rows stay dense enough to draw its curve.
// Strips that meet agree because they pass the same numbers; C++ and GLSL may differ in the last bits.
SEASCAPE_FUNCTION float skirt_scale(int row, int rows, float to_multiplier, float to_horizon) {
  if (row <= 0) return 1.0f;
  if (to_horizon <= to_multiplier) return pow(to_multiplier, float(row) / float(rows));
  int near_rows = 0;
  if (to_multiplier > 1.0f) {
    float share = clamp(log(to_multiplier) / log(to_horizon), 0.25f, 0.75f);
    near_rows = int(round(float(rows) * share));
  }
  if (row <= near_rows) return pow(to_multiplier, float(row) / float(near_rows));
  return to_multiplier * pow(to_horizon / to_multiplier, float(row - near_rows) / float(rows - near_rows));
}

SEASCAPE_SHARED_END
#endif
