#version 460
#extension GL_GOOGLE_include_directive : require
#define TILE_FORMAT rgba32f
#include "lib/wave_mips.glsl"
