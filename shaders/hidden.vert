#version 460
// What an eye cannot see of its picture, as near as reversed depth goes. The other eye's triangles lie outside of it.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/hidden_corner.h"
#include "lib/view.glsl"

layout(location = 0) in vec4 corner;  // HiddenCorner

void main() { gl_Position = int(corner.z) == eye_index() ? vec4(corner.xy, 1.0, 1.0) : vec4(0.0, 0.0, -1.0, 1.0); }
