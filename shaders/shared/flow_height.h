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
// lie `way_m` apart and of which the first counts for `first` and the second for the rest. They are alike as far as the
// way is short against their waves, by a Gaussian of the way over the band's middle wave length.
SEASCAPE_REAL_FUNCTION Real flow_height(Real longest_m, Real shortest_m, Real way_m, Real first) {
  Real way = Real(6.283185307179586) / sqrt(longest_m * shortest_m) * way_m;
  Real second = Real(1.0) - first;
  return Real(1.0) / sqrt(first * first + second * second + Real(2.0) * first * second * exp(Real(-0.5) * way * way));
}

SEASCAPE_SHARED_END
#endif
