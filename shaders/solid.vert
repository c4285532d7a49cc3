#version 460
// A corner of a solid thing in the eyes' pictures.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/solid_corner.glsl"

layout(constant_id = value_wide) const bool wide = false;  // for the picture of what is under water

void main() {
  place_corner();
  gl_Position = frame.view[eye_index()].clip_from_relative * vec4(relative, 1.0);
  if (wide) gl_Position.xy /= solid_margin;
}
