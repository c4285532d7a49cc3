// The slope of the displaced surface from derivatives over rest positions: shared by C++ and GLSL.
#ifndef SEASCAPE_SURFACE_SLOPE_H
#define SEASCAPE_SURFACE_SLOPE_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::max;
#endif

// Jacobian of the horizontal displacement D: below 0 the surface is folded over (Tessendorf 2001, eq. 45). dDx/dx,
// dDz/dz, dDx/dz, dDz/dx.
SEASCAPE_REAL_FUNCTION Real surface_jacobian(Real xx, Real zz, Real xz, Real zx) {
  return (Real(1.0) + xx) * (Real(1.0) + zz) - xz * zx;
}

// The Jacobian by which a slope is divided. Where it is 0 the slope is without bound: the size is held at 1e-3, and the
// sign is kept, for a sheet that is turned over slopes the other way.
SEASCAPE_REAL_FUNCTION Real held_jacobian(Real jacobian) {
  Real size = max(abs(jacobian), Real(1e-3));
  return jacobian < Real(0.0) ? -size : size;
}

// Slope along x and z of the surface where it stands: the inverse transpose of (I + grad D) times the height's gradient
// over rest positions.
SEASCAPE_REAL_FUNCTION SEASCAPE_REAL2 surface_slope(Real height_x, Real height_z, Real xx, Real zz, Real xz, Real zx) {
  Real held = held_jacobian(surface_jacobian(xx, zz, xz, zx));
  return SEASCAPE_REAL2(((Real(1.0) + zz) * height_x - zx * height_z) / held,
                        ((Real(1.0) + xx) * height_z - xz * height_x) / held);
}

SEASCAPE_SHARED_END
#endif
