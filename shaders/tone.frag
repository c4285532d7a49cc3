#version 460
// The desktop frame's last pass: tone mapping from the lit picture.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"
#include "lib/tone.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
layout(binding = slot_lit_picture) uniform sampler2DArray lit_picture;
layout(constant_id = value_debug) const bool debug = false;

layout(location = 0) out vec4 colour;

void main() {
  const vec4 lit = texelFetch(lit_picture, ivec3(gl_FragCoord.xy, eye_index()), 0);
  const bool raw = debug && frame.shown.x > debug_lod;
  colour = vec4(raw ? lit.rgb : tone_map(lit.rgb), 1.0);
  // A hole has no alpha; one sample of it is enough.
  if (debug && frame.shown.x == debug_holes && lit.a < 0.999) colour = vec4(1.0, 0.0, 1.0, 1.0);
}
