// The earth's curve: from the flat sea that waves are computed on to the sphere that is drawn, and back.
#ifndef SEASCAPE_EARTH_CURVE_H
#define SEASCAPE_EARTH_CURVE_H
#include "gpu_types.h"
SEASCAPE_SHARED_BEGIN
#ifdef __cplusplus
using glm::dot;
using glm::sqrt;
using glm::vec2;
using glm::vec3;
#endif

// The place of a point above a sphere of curvature `c` (1/m; 0: flat) that touches the still sea beneath the viewer: x,
// z from the viewer, y above the tangent plane there. The point is `flat_xz` metres away along the surface and `y`
// above it. Exact to 1e-9 of the distance for angles below 0.15 (Taylor).
SEASCAPE_FUNCTION vec3 curved(vec2 flat_xz, float y, float c) {
  float s2 = dot(flat_xz, flat_xz);
  float a2 = s2 * c * c;
  float sine = 1.0f - a2 * (1.0f / 6.0f - a2 / 120.0f);
  float drop = s2 * c * (0.5f - a2 * (1.0f / 24.0f - a2 / 720.0f));
  return vec3(flat_xz.x * sine * (1.0f + y * c), y - drop * (1.0f + y * c), flat_xz.y * sine * (1.0f + y * c));
}

// The way back: x and z along the surface, y above it. Its height loses no digits to the radius: (R + h)^2 = (R + y)^2
// + r^2 is solved for h without a difference of large numbers.
SEASCAPE_FUNCTION vec3 flattened(vec3 place, float c) {
  float r2 = place.x * place.x + place.z * place.z;
  float up = 1.0f + c * place.y;
  float h = (2.0f * place.y + c * (place.y * place.y + r2)) / (1.0f + sqrt(up * up + c * c * r2));
  float inverse = 1.0f / (1.0f + h * c);
  float s2 = c * c * r2 * inverse * inverse;  // of the angle's sine
  float along = inverse * (1.0f + s2 * (1.0f / 6.0f + s2 * (3.0f / 40.0f + s2 * (15.0f / 336.0f))));
  return vec3(place.x * along, h, place.z * along);
}

SEASCAPE_SHARED_END
#endif
