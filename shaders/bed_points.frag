#version 460
// The bed before an eye in the water, where the sea is lit later: its light, kept among the points of the sea.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/bed_in_water.glsl"

layout(location = 0) centroid in vec3 relative;  // metres from the viewer, world axes
layout(location = 0) out uvec4 kept_point;       // half floats of its light, and kept_solid
layout(location = 1) out uvec2 footprint;

void main() {
  const vec3 lit = min(bed_in_water(relative), vec3(6e4));
  kept_point = uvec4(packHalf2x16(lit.rg), packHalf2x16(vec2(lit.b, 0.0)), 0u, kept_solid);
  if (anisotropy > 1.0) footprint = uvec2(0u);
}
