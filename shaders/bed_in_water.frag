#version 460
// The bed before an eye in the water, where pixels are lit as they are drawn.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/bed_in_water.glsl"
#include "lib/tone.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here

layout(location = 0) centroid in vec3 relative;  // metres from the viewer, world axes
layout(location = 0) out vec4 colour;

void main() {
  vec3 lit = bed_in_water(relative);
  if (tile_shape) lit = tone_map(lit);
  colour = vec4(min(lit, vec3(6e4)), 1.0);
}
