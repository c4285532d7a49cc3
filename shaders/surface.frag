#version 460
// Lights the sea's pixels where its triangles are drawn.
#extension GL_GOOGLE_include_directive : require
#include "lib/surface_pixels.glsl"
