// Still water against a wetted plate, and a drop on it: shared by C++ and GLSL.
#ifndef SEASCAPE_MENISCUS_H
#define SEASCAPE_MENISCUS_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::asin;
using glm::cos;
using glm::log;
using glm::sin;
using glm::tan;
#endif

// The square root of surface tension over density and gravity, m: 0.0728 N/m of clean water at 20 degrees.
SEASCAPE_CONST float capillary_length_m = 0.0027f;

// The profile of a meniscus in two dimensions, by the angle between its surface and the level, in radians; lengths are
// in capillary lengths (de Gennes, Brochard-Wyart and Quere 2004, section 2.3.2). From the balance of tension and
// weight, z^2 / 2 = 1 - cos(angle): how high it stands over the level water.
SEASCAPE_REAL_FUNCTION Real meniscus_height(Real angle) { return Real(2.0) * sin(Real(0.5) * angle); }

// How far out it is there, from a point that is the same for all angles: the integral of dz / tan(angle).
SEASCAPE_REAL_FUNCTION Real meniscus_out(Real angle) {
  return -log(tan(Real(0.25) * angle)) - Real(2.0) * cos(Real(0.5) * angle);
}

// The flattest angle that meniscus_met() looks at: the surface stands 0.03 capillary lengths over the level there.
SEASCAPE_CONST float meniscus_flattest = 0.03f;

// Where a line from the plate leaves the water: the angle of the surface there, 0 where that is level water, below 0
// where it stays in the water. The surface leaves the plate at the angle `wall`; the line begins at (out, up), in
// capillary lengths from where the surface meets the plate and over the level water, and goes along (along_out,
// along_up). Within 1e-3.
SEASCAPE_REAL_FUNCTION Real meniscus_met(Real wall, Real out_from, Real up_from, Real along_out, Real along_up) {
  const Real begin = meniscus_out(wall), flattest = Real(meniscus_flattest);
  Real within = wall, beyond = wall;  // angles of surface to the left of the line and to the right of it
  bool met = false;
  for (int i = 1; i <= 16 && !met; ++i) {
    const Real share = Real(1.0) - Real(i) / Real(16.0);
    beyond = flattest + (wall - flattest) * share * share;
    met = (meniscus_height(beyond) - up_from) * along_out <= (meniscus_out(beyond) - begin - out_from) * along_up;
    if (!met) within = beyond;
  }
  if (!met) return along_up > Real(0.0) ? Real(0.0) : Real(-1.0);
  for (int i = 0; i < 10; ++i) {
    const Real middle = Real(0.5) * (within + beyond);
    if ((meniscus_height(middle) - up_from) * along_out <= (meniscus_out(middle) - begin - out_from) * along_up)
      beyond = middle;
    else
      within = middle;
  }
  return beyond;
}

SEASCAPE_SHARED_END
#endif
