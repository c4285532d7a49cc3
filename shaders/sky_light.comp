#version 460
// What the sky gives a level sea, and the exposure that suits it: one workgroup over the map.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/sky_push.h"
#include "lib/atmosphere.glsl"
#include "lib/sky.glsl"
#include "lib/tone.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Light { SkyLight light; };
layout(binding = 1, rgba16f) readonly uniform image2D sky_map;
layout(push_constant) uniform Push { SkyPush push; };

shared vec3 sums[64];

void main() {
  const uint lane = gl_LocalInvocationIndex;
  vec3 sum = vec3(0.0);
  for (uint x = lane; x < uint(sky_map_width); x += 64u) {
    // The azimuth that a column spans on the square, and dy = 2 v dv for the sine of elevation y = v^2.
    const float turn = (float(x) + 0.5) / float(sky_map_width) * 4.0, p = abs(fract(turn) - 0.5) + 0.5;
    const float azimuth = 4.0 / float(sky_map_width) / (p * p + (1.0 - p) * (1.0 - p));
    for (int y = 0; y < sky_map_height; ++y) {
      const float v = (float(y) + 0.5) / float(sky_map_height);
      sum += imageLoad(sky_map, ivec2(x, y)).rgb * (azimuth * 2.0 * v / float(sky_map_height) * v * v);
    }
  }
  sums[lane] = sum;
  barrier();
  for (uint half_size = 32u; half_size > 0u; half_size >>= 1) {  // a fixed tree, so that the sum never changes
    if (lane < half_size) sums[lane] += sums[lane + half_size];
    barrier();
  }
  if (lane == 0u) {
    const vec3 sun = sun_above_air * sunlight(vec3(0.0, air_ground + 5.0, 0.0), push.sun.xyz, push.sun.w);
    light.sun_irradiance = vec4(sun, 1.0);
    light.sky_irradiance = vec4(sums[0], 1.0);
    // A picture of sea and sky is mostly sky light; the sun counts by what a rough sea mirrors of it.
    const float key = luminance(sums[0]) / 3.14159265 + 0.03 * luminance(sun) * (0.2 + max(push.sun.y, 0.0));
    light.exposure = vec4(0.38 / max(key, 2e-6), 0.0, 0.0, 0.0);
  }
}
