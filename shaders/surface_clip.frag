#version 460
// surface.frag where water is taken away from a multisampled picture: by the sample, so that edges are as fine as those
// of triangles.
#extension GL_GOOGLE_include_directive : require
#define CLIP_EACH_SAMPLE
#include "lib/surface_pixels.glsl"
