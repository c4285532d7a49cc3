// Looking up the sky map: radiance by direction. Across goes the azimuth, measured around a square so that it needs no
// arc tangent; up goes the square root of the sine of elevation, which is fine at the horizon.
#ifndef SEASCAPE_SKY_GLSL
#define SEASCAPE_SKY_GLSL
#include "shared/sky_push.h"

vec2 sky_coordinate(vec3 direction) {
  const float p = direction.x / max(abs(direction.x) + abs(direction.z), 1e-6);
  const float across = direction.z < 0.0 ? 0.25 * p : 0.5 - 0.25 * p;  // 0 towards -z, a quarter towards +x
  // Within the first and last rows' centres: the sampler repeats, and the zenith must not bleed into the horizon.
  const float half_row = 0.5 / float(sky_map_height);
  return vec2(across, clamp(sqrt(max(direction.y, 0.0)), half_row, 1.0 - half_row));
}

vec3 sky_direction(vec2 at) {
  const float turn = fract(at.x) * 4.0;  // quarters
  const float p = turn < 1.0 ? turn : turn < 3.0 ? 2.0 - turn : turn - 4.0;
  const float q = (turn < 1.0 || turn > 3.0 ? -1.0 : 1.0) * (1.0 - abs(p));
  const float y = at.y * at.y;
  return vec3(normalize(vec2(p, q)) * sqrt(max(1.0 - y * y, 0.0)), y).xzy;
}
#endif
