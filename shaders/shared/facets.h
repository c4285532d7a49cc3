// Which facets of a rough sea an eye sees, in two slopes: shared by C++ and GLSL.
#ifndef SEASCAPE_FACETS_H
#define SEASCAPE_FACETS_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::exp;
using glm::max;
using glm::min;
using glm::sqrt;
using glm::vec3;
#endif

// Slopes along the line of sight are Gaussian about `mean` with standard deviation `spread` (above 0). Each facet
// counts by how much of it the eye sees, max(tangent - slope, 0) with `tangent` of the elevation from which it looks
// (Ross 2005; Bruneton 2010). x, y: the two slopes that share mean and variance with that distribution, so that half
// the sum of a function at both is its average but for its third derivatives; both are seen. z: the mean of max(tangent
// - slope, 0), above 0. With a = (tangent - mean) / spread, and phi and Phi the normal density and distribution, the
// moments of z under (a - z) phi(z) are a Phi + phi, -Phi, a Phi + 2 phi (integration by parts). A mean slope that lies
// more than two spreads beyond what can be seen is taken as two: hardly any of it is.
SEASCAPE_FUNCTION vec3 visible_facets(float tangent, float mean, float spread) {
  float middle = min(mean, tangent + 2.0f * spread);
  float a = (tangent - middle) / spread;
  float bell = exp(-0.5f * a * a);
  float density = 0.39894228f * bell;  // phi
  // The share beyond |a|, within 1e-7 (Abramowitz and Stegun 7.1.26, halved).
  float t = 1.0f / (1.0f + 0.23164190f * abs(a));
  float beyond =
      bell * t * (0.127414796f + t * (-0.142248368f + t * (0.710706870f + t * (-0.726576013f + t * 0.530702714f))));
  float below = a > 0.0f ? 1.0f - beyond : beyond;  // Phi
  float seen = max(a * below + density, 1e-3f);
  float centre = -below / seen;
  float width = sqrt(max((a * below + 2.0f * density) / seen - centre * centre, 0.0f));
  return vec3(middle + spread * (centre - width), middle + spread * (centre + width), spread * seen);
}

SEASCAPE_SHARED_END
#endif
