#version 460
// A puff's pixels: ragged mist, or drops that are told apart, never a disc.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(constant_id = value_depth_sampled) const
    bool depth_sampled = false;  // the sea's depth is a picture, not this pass's
layout(binding = slot_sea_depths) uniform sampler2DArray sea_depths;

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 colour;
layout(location = 2) flat in vec4 shape;

layout(location = 0) out vec4 shown;

// Even numbers of whole places (Jarzynski and Olano 2020: pcg2d's second half).
float chance(ivec2 p) {
  uvec2 v = uvec2(p) * 1664525u + 1013904223u;
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  v ^= v >> 16u;
  v.x += v.y * 1664525u;
  return float((v.x ^ (v.x >> 16u)) >> 8u) * (1.0 / 16777216.0);
}

float noise(vec2 p) {
  const ivec2 i = ivec2(floor(p));
  const vec2 f = p - vec2(i), s = f * f * (3.0 - 2.0 * f);
  return mix(mix(chance(i), chance(i + ivec2(1, 0)), s.x), mix(chance(i + ivec2(0, 1)), chance(i + ivec2(1, 1)), s.x),
             s.y);
}

// What a puff of coarse drops hides at a place in radii: from afar ragged clumps, near by a haze in which drops of some
// millimetres are told apart where pixels are fine enough. `a_pixel`: of the place.
float coarse_drops(vec2 place, float within, float a_pixel) {
  const float clumps = noise(6.0 * place) + 0.25 * (within - 0.5), ragged = smoothstep(0.66, 0.8, clumps);
  const float near_by = smoothstep(2.0, 5.0, 1.0 / (6.0 * a_pixel));
  if (near_by <= 0.0) return ragged;
  const float dense = smoothstep(0.35, 0.95, clumps), cells = max(colour.w / 0.008, 12.0),
              told = smoothstep(1.2, 2.4, 1.0 / (cells * a_pixel));
  const float drops = smoothstep(0.85 - 0.35 * dense, 1.0 - 0.35 * dense, noise(cells * place));
  return mix(ragged, mix(0.3 * dense, 0.8 * drops, told), near_by);
}

void main() {
  const float a_pixel = length(vec2(length(dFdx(at)), length(dFdy(at)))) * sqrt(0.5);
  if (depth_sampled && gl_FragCoord.z <= texelFetch(sea_depths, ivec3(gl_FragCoord.xy, eye_index()), 0).r) discard;
  const vec2 off = vec2(at.x - clamp(at.x, -shape.x, shape.x), at.y);  // from the way it is drawn out along
  const float within = 1.0 - dot(off, off);
  if (within <= 0.0) discard;
  const vec2 place = vec2(at.x / (1.0 + shape.x), at.y) + 300.0 * vec2(shape.z, fract(shape.z * 77.0));
  const float cloud = 0.6 * noise(2.7 * place) + 0.4 * noise(6.9 * place);
  const float mist = within * within * smoothstep(0.1, 1.0, within + 1.8 * (cloud - 0.55)),
              drops = coarse_drops(place, within, a_pixel) * sqrt(within);
  shown = vec4(colour.rgb, shape.y * mix(mist, drops, shape.w));
}
