// Looking up the sky map: radiance by direction, azimuth across, elevation as the square of the row (fine at the horizon).
#ifndef SEASCAPE_SKY_GLSL
#define SEASCAPE_SKY_GLSL

vec2 sky_coordinate(vec3 direction) {
  const float elevation = asin(clamp(direction.y, 0.0, 1.0));
  return vec2(atan(direction.x, -direction.z) * 0.15915494, sqrt(elevation * 0.63661977));
}

vec3 sky_direction(vec2 at) {
  const float elevation = at.y * at.y * 1.57079633, azimuth = at.x * 6.28318531;
  return vec3(sin(azimuth) * cos(elevation), sin(elevation), -cos(azimuth) * cos(elevation));
}
#endif
