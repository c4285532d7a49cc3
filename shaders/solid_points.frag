#version 460
// A solid thing's pixels where the sea is lit later: its light, kept among the points of the sea.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/solid_light.glsl"
layout(constant_id = value_anisotropy) const float anisotropy = 1.0;

layout(location = 0) out uvec4 kept_point;  // half floats of its light, and kept_solid
layout(location = 1) out uvec2 footprint;

void main() {
  const vec3 lit = min(solid_light().rgb, vec3(6e4));
  kept_point = uvec4(packHalf2x16(lit.rg), packHalf2x16(vec2(lit.b, 0.0)), 0u, kept_solid);
  if (anisotropy > 1.0) footprint = uvec2(0u);
}
