// Light along a straight line through even water: shared by C++ and GLSL.
#ifndef SEASCAPE_WATER_VOLUME_H
#define SEASCAPE_WATER_VOLUME_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::exp;
using glm::max;
using glm::sqrt;
#endif

// How far forward sea water scatters: the mean cosine (Petzold 1972; Mobley 1994, section 3.8).
SEASCAPE_CONST float water_forward = 0.924f;

// Share a steradian of what is scattered by an angle of this cosine (Henyey and Greenstein 1941).
SEASCAPE_REAL_FUNCTION Real henyey_greenstein(Real cosine, Real g) {
  Real d = max(Real(1.0) + g * g - Real(2.0) * g * cosine, Real(1e-4));
  return (Real(1.0) - g * g) / (Real(12.566370614359172) * d * sqrt(d));
}

// Integral of exp(-k t) from 0 to `way`, metres, for k (1/m) of either sign. Its error is a part in 10^6 in floats.
SEASCAPE_REAL_FUNCTION Real path_sum(Real k, Real way) {
  Real x = k * way;
  if (abs(x) < Real(0.02)) return way * (Real(1.0) - x * (Real(0.5) - x * (Real(1.0 / 6.0) - x * Real(1.0 / 24.0))));
  return (Real(1.0) - exp(-x)) / k;
}

// Of sunlight, what `way` metres of a line of sight scatter to the eye: the radiance over the irradiance under the
// surface on a plane that faces the sun. `scattering`, `attenuation` (of the line of sight) and `fading` (of the light
// with depth) in 1/m; `depth`: of the eye, m; `falls`: metres that the line goes down a metre; `cosine`: between the
// line and the way to the sun, under water. One scattering where fading is the attenuation over the sun's cosine; with
// the fading of irradiance also what was scattered forwards before (Duntley 1963).
SEASCAPE_REAL_FUNCTION Real sun_scattered(Real scattering, Real attenuation, Real fading, Real depth, Real falls,
                                          Real way, Real cosine) {
  return scattering * henyey_greenstein(cosine, Real(water_forward)) * exp(-fading * depth) *
         path_sum(attenuation + fading * falls, way);
}

SEASCAPE_SHARED_END
#endif
