// How much light a still facet of water mirrors: shared by C++ and GLSL.
#ifndef SEASCAPE_FRESNEL_H
#define SEASCAPE_FRESNEL_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp;
using glm::sqrt;
#endif

SEASCAPE_CONST float water_index = 1.333f;  // of refraction

// Unpolarised Fresnel reflectance from air, exact (Born and Wolf 1999, section 1.5.2), for the cosine of incidence.
SEASCAPE_FUNCTION float fresnel(float cosine) {
  float c = clamp(cosine, 0.0f, 1.0f);
  float g = sqrt(water_index * water_index - 1.0f + c * c);
  float s = (g - c) / (g + c);
  float p = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
  return 0.5f * s * s * (1.0f + p * p);
}

SEASCAPE_SHARED_END
#endif
