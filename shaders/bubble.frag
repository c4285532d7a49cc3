#version 460
// A bubble's pixels: a lens of air in the water. Around its edge, where light meets it at more than 48.6 degrees, it
// mirrors all that is around it; in its middle it shows what lies behind it, made small.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sky_light.glsl"
#include "lib/tone.glsl"
#include "lib/underwater.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here
layout(constant_id = value_depth_sampled) const
    bool depth_sampled = false;  // depth and sides of the sea are pictures, not this pass's
layout(binding = slot_sea_depths) uniform sampler2DArray sea_depths;
layout(binding = slot_point_sides) uniform usampler2DArray sides;

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec3 middle;
layout(location = 2) flat in vec3 side;
layout(location = 3) flat in vec3 up;
layout(location = 4) flat in float flatness;

layout(location = 0) out vec4 shown;

// What comes through the water along `ray` to a place `depth` metres deep: the sky in Snell's window, or the water.
vec3 around(float depth, vec3 ray) {
  const vec3 leaves = ray.y > 0.0 ? refract(ray, vec3(0.0, -1.0, 0.0), water_index) : vec3(0.0);
  if (leaves.y <= 0.0) return open_water(depth, ray);
  const float way = depth / max(ray.y, 1e-2);
  const vec3 sky = textureLod(sky_map, sky_coordinate(leaves), 0.0).rgb * (1.0 - fresnel(leaves.y));
  return sky * water_passed(way) + water_added(depth, ray, way);
}

void main() {
  const ivec3 pixel = ivec3(gl_FragCoord.xy, eye_index());
  if (depth_sampled && gl_FragCoord.z <= texelFetch(sea_depths, pixel, 0).r) discard;
  if (depth_sampled && texelFetch(sides, pixel, 0).r >= side_in_air) discard;
  const float off2 = dot(at, at), off = sqrt(off2), edge = fwidth(off);
  const float within = clamp((1.0 - off) / max(edge, 1e-4) + 0.5, 0.0, 1.0);
  if (within <= 0.0) discard;
  const ViewData view = frame.view[eye_index()];
  const vec3 place = middle + at.x * side + at.y * up, line = place - view.eye.xyz;
  const float way = max(length(line), 1e-3);
  const vec3 ray = line / way;
  // Of a ball its normal; of one pressed flat the normal leans to the vertical as much as it is flat.
  const vec3 right = normalize(side), above = normalize(up);
  const float in_disc = min(off2, 0.998);
  vec3 n = (at.x * right + at.y * above) * sqrt(in_disc / max(off2, 1e-6)) - sqrt(1.0 - in_disc) * ray;
  n = normalize(vec3(n.x, n.y / flatness, n.z));
  const float cosine = max(-dot(ray, n), 0.02);
  if (dot(ray, n) > -0.02) n = normalize(n - (dot(ray, n) + 0.02) * ray);

  const float depth = depth_in_water(place.y);
  const vec3 inside = refract(ray, n, water_index);
  float mirrored = 1.0;
  vec3 lit = vec3(0.0);
  if (inside != vec3(0.0)) {
    mirrored = fresnel(-dot(inside, n));
    // Through a ball the way out is turned as much again.
    const vec3 out_at = n - 2.0 * dot(n, inside) * inside;
    const vec3 leaves = refract(inside, -out_at, 1.0 / water_index);
    lit = (1.0 - mirrored) * around(depth, leaves);
  }
  lit += mirrored * around(depth, reflect(ray, n));
  if (lamp_carried && lamp_shines()) {  // a small mirror of the lamp
    const LampThere there = lamp_there(place);
    const vec3 half_way = normalize(there.towards - ray);
    const float spark = max(dot(half_way, n), 0.0);
    lit += there.irradiance * (0.1 * smoothstep(0.985, 0.997, spark) / (water_index * water_index));
  }
  lit = lit * water_passed(way) + water_added_to_eye(view.eye.xyz, ray, 0.0, way, 0.0);
  lit *= light.exposure.x * exp2(frame.air.y);
  if (tile_shape) lit = tone_map(lit);
  // What lies behind its middle shows through. Before the nose it fades: no two eyes look at what is so near.
  const float near = smoothstep(0.2, 0.5, length(middle));
  shown = vec4(min(lit, vec3(6e4)), near * within * mix(0.35, 1.0, smoothstep(0.03, 0.5, mirrored)));
}
