#version 460
// Light scattered twice and more, by height and sun elevation, as if equal from all sides (Hillaire 2020, section 5.5).
#extension GL_GOOGLE_include_directive : require
#include "shared/sky_push.h"
#include "lib/atmosphere.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) writeonly buffer Multiple { vec4 multiple[]; };
layout(push_constant) uniform Push { SkyPush push; };

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  const vec2 f = (vec2(at) + 0.5) / float(sky_multiple_size);
  const float sine = f.x * 2.0 - 1.0, height = f.y * f.y * (air_top - air_ground);
  const vec3 origin = vec3(0.0, air_ground + height + 1.0, 0.0);
  const vec3 sun = vec3(0.0, sine, -sqrt(max(0.0, 1.0 - sine * sine)));
  const float haze = push.sun.w;
  vec3 second = vec3(0.0), transfer = vec3(0.0);
  const int directions = 8;
  for (int i = 0; i < directions; ++i)
    for (int j = 0; j < directions; ++j) {
      const float y = 1.0 - 2.0 * (float(i) + 0.5) / float(directions),
                  azimuth = 6.2831853 * (float(j) + 0.5) / float(directions);
      const vec3 ray = vec3(sqrt(1.0 - y * y) * vec2(cos(azimuth), sin(azimuth)), y).xzy;
      const bool ground = meets_ground(origin, ray);
      const float b = dot(origin, ray);
      const float length_m = ground ? -b - sqrt(max(b * b - dot(origin, origin) + air_ground * air_ground, 0.0))
                                    : to_sphere(origin, ray, air_top);
      const int steps = 16;
      const float step_m = length_m / float(steps);
      vec3 through = vec3(1.0);
      for (int k = 0; k < steps; ++k) {
        const vec3 p = origin + ray * (float(k) + 0.5) * step_m;
        const Air a = air_at(max(length(p) - air_ground, 0.0), haze);
        const vec3 scattering = a.rayleigh + a.aerosol;
        const vec3 kept = exp(-a.extinction * step_m);
        const vec3 gathered = through * (1.0 - kept) / a.extinction;
        second += gathered * scattering * sunlight(p, sun, haze) * 0.0795774715;  // isotropic phase 1 / (4 pi)
        transfer += gathered * scattering;
        through *= kept;
      }
      if (ground) {
        const vec3 p = origin + ray * length_m;
        second += through * 0.06 * 0.318309886 * max(dot(normalize(p), sun), 0.0) * sunlight(p * 1.000001, sun, haze);
      }
    }
  const float share = 1.0 / float(directions * directions);
  second *= share;
  transfer *= share;
  multiple[at.y * sky_multiple_size + at.x] = vec4(second / (1.0 - min(transfer, vec3(0.95))), 1.0);
}
