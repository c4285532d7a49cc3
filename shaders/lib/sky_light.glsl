// The sky's own light: its map, and the sun's disc. Included after the uniform block `frame` has been declared.
#ifndef SEASCAPE_SKY_LIGHT_GLSL
#define SEASCAPE_SKY_LIGHT_GLSL
#include "lib/sky.glsl"

layout(binding = slot_sky_map) uniform sampler2D sky_map;
layout(binding = slot_sky_light) uniform Light { SkyLight light; };

// Radiance of the sky along `ray`, of unit length; `pixel`: radians a pixel.
vec3 sky_light(vec3 ray, float pixel) {
  vec3 sky = textureLod(sky_map, sky_coordinate(ray), 0.0).rgb;
  // The disc, darkened towards its limb (Pierce and Slaughter 1977, 550 nm, first order), with an edge a pixel wide.
  const float cosine = dot(ray, frame.sun.xyz), radius = sqrt(2.0 * (1.0 - frame.sun.w));
  if (cosine > 0.9995 && ray.y > 0.0) {
    const float off = length(ray - frame.sun.xyz);  // the chord, which is the angle to 1e-5 here
    const float inside = 1.0 - smoothstep(radius - 0.5 * pixel, radius + 0.5 * pixel, off);
    const float mu = sqrt(max(1.0 - (off / radius) * (off / radius), 0.0));
    const float solid = 6.2831853 * (1.0 - frame.sun.w);
    sky += inside * light.sun_irradiance.rgb * (0.4 + 0.6 * mu) * 1.25 / solid;
  }
  return sky;
}

// Light from a place at sea as it comes through the air to the eye, which is `range` metres from there in direction
// `v`: what air takes away, and what it adds: far off the sky's light from just above the horizon, beneath the viewer,
// where no horizon lies behind, the mean of the sky's. Its first half per cent is left out, so that near water need not
// look at the sky.
vec3 through_air(vec3 lit, vec3 v, float range) {
  const float haze = 1.0 - exp(-frame.air.x * range) - 0.005;
  if (haze <= 0.0) return lit;
  const vec3 horizon = textureLod(sky_map, sky_coordinate(normalize(vec3(-v.x, 0.012, -v.z))), 0.0).rgb;
  return mix(lit, mix(horizon, light.sky_irradiance.rgb * (0.5 / 3.14159265), smoothstep(0.05, 0.6, v.y)),
             haze / 0.995);
}

// Whether sky along `ray` is a hole in the sea: beneath the lowest line where any water must be seen, nothing but the
// sea may lie.
bool is_hole(vec3 ray, ViewData view) {
  const float h = max(frame.viewer.z + view.eye.y + frame.sea.footprint.z, 0.0), c = frame.viewer.w;
  const float dip = sqrt(2.0 * h * c + h * h * c * c) / (1.0 + h * c);  // sine of the dip (0 when flat)
  return ray.y < -dip - 2.0 * view.eye.w;
}

// Pure magenta after tone mapping, which knows a hole by its alpha.
vec4 hole_colour(bool tone_mapped) { return tone_mapped ? vec4(1.0, 0.0, 1.0, 1.0) : vec4(0.0); }
#endif
