#version 460
// The sky behind everything: the map, and the sun's disc.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"
#include "lib/tone.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sky_light.glsl"
#include "lib/underwater.glsl"
layout(constant_id = value_tile_shape) const bool tile_shape = false;
layout(constant_id = value_debug) const bool debug = false;

layout(location = 0) in vec3 pixel_ray;
layout(location = 0) out vec4 colour;

void main() {
  const vec3 ray = normalize(pixel_ray);
  const ViewData view = frame.view[eye_index()];
  vec3 lit;
  if (underwater)  // drawn where the stencil has eyes in the water
    lit = open_water_seen(ray, view);
  else
    lit = sky_light(ray, view.eye.w);
  lit *= light.exposure.x * exp2(frame.air.y);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
  if (debug && frame.shown.x == debug_holes && !underwater && is_hole(ray, view)) colour = hole_colour(tile_shape);
}
