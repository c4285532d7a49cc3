#version 460
// What the drawn surface says of each pixel, kept for surface_light.frag to light once, however many triangles met there.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"

layout(location = 1) in vec2 rest;
layout(location = 2) in vec2 height_shear;
layout(location = 3) in vec4 derivatives;

// Bits: a float may not pass through a picture unchanged, an integer does. What is not drawn is known by its depth.
layout(location = 0) out uvec4 place;   // rest x, z; as half floats height and shear, and the rest position's change along x
layout(location = 1) out uvec4 change;  // as half floats: the vertices' derivatives (two); the rest position's change along y; unused

void main() {
  place = uvec4(floatBitsToUint(rest), packHalf2x16(height_shear), packHalf2x16(clamp(dFdx(rest), -6e4, 6e4)));
  change = uvec4(packHalf2x16(derivatives.xy), packHalf2x16(derivatives.zw), packHalf2x16(clamp(dFdy(rest), -6e4, 6e4)), 0u);
}
