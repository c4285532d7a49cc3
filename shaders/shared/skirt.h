// How far outwards each row of the horizon skirt lies, as a multiple of its distance from the tree's centre at row 0.
#ifndef SEASCAPE_SKIRT_H
#define SEASCAPE_SKIRT_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp;
using glm::log;
using glm::pow;
using glm::round;
#endif

SEASCAPE_CONST float earth_radius_m = 6371000.0f;

// Rows beyond the multiplier grow by this: the highest of them then stands within 0.01 degrees of the horizon from 10
// km (its dip times the square of half of what it is above 1, halved).
SEASCAPE_CONST float skirt_growth = 1.13f;

// Exactly 1 at row 0, growing with every row, geometric so that the rows' spacing follows distance. `to_multiplier` (1
// or more) is where the patches' density ends, `to_horizon` (as much or more) where the skirt does: as many of the last
// rows as there are powers of skirt_growth between the two lie beyond the multiplier, the others before it. A farther
// horizon adds rows and leaves all others where they are, so that nothing moves when the viewer rises. Strips that meet
// agree because they pass the same numbers; C++ and GLSL may differ in the last bits.
SEASCAPE_FUNCTION float skirt_scale(int row, int rows, float to_multiplier, float to_horizon) {
  if (row <= 0) return 1.0f;
  int far_rows = int(round(log(to_horizon / to_multiplier) / log(skirt_growth)));
  int near_rows = rows - clamp(far_rows, 0, rows);
  if (row <= near_rows) return pow(to_multiplier, float(row) / float(near_rows));
  return to_multiplier * pow(to_horizon / to_multiplier, float(row - near_rows) / float(rows - near_rows));
}

SEASCAPE_SHARED_END
#endif
