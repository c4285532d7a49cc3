#version 460
#extension GL_GOOGLE_include_directive : require
#define FFT_RADIX 16
#include "transform.glsl"
