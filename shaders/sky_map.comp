#version 460
// The sky as seen from the sea, by direction: one march through the air a texel.
#extension GL_GOOGLE_include_directive : require
#include "shared/sky_push.h"
#include "lib/atmosphere.glsl"
#include "lib/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) readonly buffer Multiple { vec4 multiple[]; };
layout(binding = 1, rgba16f) writeonly uniform image2D sky_map;
layout(push_constant) uniform Push { SkyPush push; };

vec3 multiple_at(float sine, float height) {
  const float n = float(sky_multiple_size);
  const vec2 at =
      clamp(vec2((sine * 0.5 + 0.5) * n, sqrt(height / (air_top - air_ground)) * n) - 0.5, vec2(0.0), vec2(n - 1.001));
  const ivec2 i = ivec2(at);
  const vec2 f = at - vec2(i);
  const int row = i.y * sky_multiple_size + i.x;
  return mix(mix(multiple[row].rgb, multiple[row + 1].rgb, f.x),
             mix(multiple[row + sky_multiple_size].rgb, multiple[row + sky_multiple_size + 1].rgb, f.x), f.y);
}

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  const vec3 ray = sky_direction((vec2(at) + 0.5) / vec2(sky_map_width, sky_map_height));
  const vec3 sun = push.sun.xyz, origin = vec3(0.0, air_ground + 5.0, 0.0);
  const float haze = push.sun.w, cosine = dot(ray, sun);
  const float length_m = to_sphere(origin, ray, air_top);
  const int steps = 40;
  vec3 radiance = vec3(0.0), through = vec3(1.0);
  float before = 0.0;
  for (int k = 0; k < steps; ++k) {
    const float f = (float(k) + 1.0) / float(steps), end = length_m * f * f;
    const float step_m = end - before;
    const vec3 p = origin + ray * (before + 0.5 * step_m);
    const float radius = length(p), height = max(radius - air_ground, 0.0);
    const Air a = air_at(height, haze);
    const vec3 direct =
        sunlight(p, sun, haze) * (a.rayleigh * rayleigh_phase(cosine) + a.aerosol * aerosol_phase(cosine));
    const vec3 bounced = multiple_at(dot(p, sun) / radius, height) * (a.rayleigh + a.aerosol);
    const vec3 kept = exp(-a.extinction * step_m);
    radiance += through * (direct + bounced) * (1.0 - kept) / a.extinction;
    through *= kept;
    before = end;
  }
  radiance *= sun_above_air;
  // Starlight and airglow: the night sea is dark, not black.
  radiance += vec3(2.0, 2.6, 4.0) * 1e-6;
  imageStore(sky_map, at, vec4(radiance, 1.0));
}
