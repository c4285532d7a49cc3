#version 460
// Lights each pixel of a picture once: the sea from what surface_points.frag has kept of it, and the sky where it kept nothing.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = 0) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/tone.glsl"

layout(binding = 16) uniform usampler2DArray places;
layout(binding = 17) uniform usampler2DArray changes;
layout(binding = 18) uniform sampler2DArray depths;

layout(constant_id = 2) const bool tile_shape = false;  // tone mapping here
layout(constant_id = 4) const bool debug = false;

layout(location = 0) in vec3 pixel_ray;
layout(location = 0) out vec4 colour;

void main() {
  const ivec3 at = ivec3(gl_FragCoord.xy, eye_index());
  const ViewData view = frame.view[eye_index()];
  const float depth = texelFetch(depths, at, 0).r;
  vec3 lit;
  if (depth == 0.0) {
    lit = sky_light(normalize(pixel_ray), view.eye.w);
  } else {
    const uvec4 place = texelFetch(places, at, 0), change = texelFetch(changes, at, 0);
    SurfacePoint p;
    // Reversed depth without a far plane: near over the distance along the line of sight's axis, which is the ray's own measure.
    p.relative = view.eye.xyz + pixel_ray * (frame.air.z / depth);
    p.rest = uintBitsToFloat(place.xy);
    p.height_shear = unpackHalf2x16(place.z);
    p.derivatives = vec4(unpackHalf2x16(change.x), unpackHalf2x16(change.y));
    p.along = unpackHalf2x16(place.w);
    p.across = unpackHalf2x16(change.z);
    vec3 normal;
    lit = sea_light(p, view, normal);
  }
  lit *= light.exposure.x * exp2(frame.air.y);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
  if (debug && frame.grid.w == debug_holes && depth == 0.0 && is_hole(normalize(pixel_ray), view)) colour = hole_colour(tile_shape);
}
