// How high the sum of two patterns of waves stands that a current carries: shared by C++ and GLSL.
#ifndef SEASCAPE_FLOW_HEIGHT_H
#define SEASCAPE_FLOW_HEIGHT_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::exp;
using glm::sqrt;
#endif

// What the weighted sum of two patterns of one band of waves has to be multiplied by to stand as high as either, which
// lie (way_x, way_z) metres apart and of which the first counts for `first` and the second for the rest. `xx`, `zz`,
// `xz`: how fast they cease to be alike, 1/m^2 (PatternMoments::decay_per_m2).
SEASCAPE_REAL_FUNCTION Real flow_height(Real xx, Real zz, Real xz, Real way_x, Real way_z, Real first) {
  Real alike = exp(-(xx * way_x * way_x + zz * way_z * way_z + Real(2.0) * xz * way_x * way_z));
  Real second = Real(1.0) - first;
  return Real(1.0) / sqrt(first * first + second * second + Real(2.0) * first * second * alike);
}

SEASCAPE_SHARED_END
#endif
