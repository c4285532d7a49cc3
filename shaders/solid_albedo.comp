#version 460
// What a rough surface mirrors of white surroundings (Karis 2013, "split sum"): a scale of its reflectance at normal
// incidence, and what is added to it. Across: n.v; up: glTF's roughness.
#extension GL_GOOGLE_include_directive : require
#include "shared/solid_data.h"
#include "lib/ggx.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba16f) writeonly uniform image2D table;

const uint samples = 1024u;

void main() {
  const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  const vec2 place = vec2(at) / float(solid_albedo_side - 1);
  const float nv = max(place.x, 1e-3), rough = max(place.y, 0.03), a = rough * rough;
  const vec3 v = vec3(sqrt(1.0 - nv * nv), 0.0, nv);
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < samples; ++i) {
    const vec3 h = ggx_visible_facet(i, samples, v, a), l = 2.0 * dot(v, h) * h - v;
    if (l.z <= 0.0) continue;
    const float vh = max(dot(v, h), 0.0), f = pow(1.0 - vh, 5.0);
    // Masking of both over that of what is seen.
    const float g = 2.0 * ggx_seen(l.z, nv, a) * l.z * (nv + sqrt(nv * nv * (1.0 - a * a) + a * a));
    sum += vec2(1.0 - f, f) * g;
  }
  imageStore(table, at, vec4(sum / float(samples), 0.0, 1.0));
}
