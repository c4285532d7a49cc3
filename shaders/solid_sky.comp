#version 460
// Sky and sea as surfaces of a layer's roughness mirror them, seen from above their mirror (Karis 2013), and in the
// last layer as a white wall shows them. The sun's disc is left out: it shines by itself.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/fresnel.h"
#include "shared/solid_data.h"
#include "lib/ggx.glsl"
#include "lib/octahedron.glsl"
#include "lib/sky.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D sky_map;
layout(std430, binding = 1) readonly buffer Light { SkyLight light; };
layout(binding = 2, rgba16f) writeonly uniform image2DArray mirrored;
layout(push_constant) uniform Push { SolidSkyPush push; };

const uint samples = 128u;

// Below the horizon a level sea: the sky in it, and its own light.
vec3 surroundings(vec3 d) {
  const vec3 sky = textureLod(sky_map, sky_coordinate(vec3(d.x, abs(d.y), d.z)), 0.0).rgb;
  if (d.y >= 0.0) return sky;
  const float f = fresnel(-d.y);
  const vec3 below = push.water_reflectance.rgb *
                     (0.93 * light.sky_irradiance.rgb + push.water_reflectance.w * light.sun_irradiance.rgb);
  return f * sky + (1.0 - f) * below;
}

void main() {
  const ivec3 at = ivec3(gl_GlobalInvocationID);
  const vec3 n = octahedron_direction((vec2(at.xy) + 0.5) / float(solid_sky_side));
  const vec3 across = normalize(abs(n.y) < 0.9 ? vec3(-n.z, 0.0, n.x) : vec3(0.0, n.z, -n.y)), along = cross(n, across);
  vec3 sum = vec3(0.0);
  float weight = 0.0;
  const bool wall = at.z == solid_sky_layers - 1;
  const float rough = mix(solid_least_rough, 1.0, float(at.z) / float(solid_sky_layers - 2));
  for (uint i = 0u; i < samples; ++i) {
    vec3 l;
    float w = 1.0;
    if (wall) {  // by the cosine
      const float u = (float(i) + 0.5) / float(samples),
                  turn = 6.2831853 * float(bitfieldReverse(i)) * 2.3283064365386963e-10;
      l = vec3(cos(turn) * sqrt(u), sin(turn) * sqrt(u), sqrt(1.0 - u));
    } else {
      const vec3 h = ggx_facet(i, samples, rough * rough);
      l = vec3(2.0 * h.z * h.xy, 2.0 * h.z * h.z - 1.0);
      w = max(l.z, 0.0);
    }
    if (w <= 0.0) continue;
    sum += w * surroundings(l.x * across + l.y * along + l.z * n);
    weight += w;
  }
  imageStore(mirrored, at, vec4(sum / max(weight, 1e-6), 1.0));
}
