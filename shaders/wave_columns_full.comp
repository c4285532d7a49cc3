#version 460
#extension GL_GOOGLE_include_directive : require
#define TILE_FORMAT rgba32f
#define FFT_RADIX 8
#include "lib/wave_columns.glsl"
