#version 460
// In place of what surface_points.frag keeps: the depth says that nobody reads it.
#extension GL_GOOGLE_include_directive : require
#include "shared/slots.h"

layout(constant_id = value_anisotropy) const float anisotropy = 1.0;

layout(location = 0) out uvec4 kept_point;
layout(location = 1) out uvec2 footprint;

void main() {
  kept_point = uvec4(0u);
  if (anisotropy > 1.0) footprint = uvec2(0u);
}
