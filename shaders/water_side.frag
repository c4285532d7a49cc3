#version 460
// Of the lines of sight those that end in the water where they meet nothing: what is left of them is counted as such.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sky_light.glsl"
#include "lib/underwater.glsl"

layout(location = 0) in vec3 pixel_ray;

void main() {
  if (ends_in_air(pixel_ray, frame.view[eye_index()])) discard;
}
