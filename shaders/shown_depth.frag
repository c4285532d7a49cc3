#version 460
// The depth of a frame's pass, for who shows the picture: the pass's own image has a stencil beside it, or is read by
// its light.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_point_depths) uniform sampler2DArray depths;

void main() { gl_FragDepth = texelFetch(depths, ivec3(gl_FragCoord.xy, eye_index()), 0).r; }
