#version 460
// A solid thing's pixels where they are lit as they are drawn.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/solid_light.glsl"

layout(constant_id = value_tile_shape) const bool tile_shape = false;  // tone mapping here
layout(constant_id = value_blend) const bool blends = false;           // what lies behind shows through
layout(constant_id = value_depth_sampled) const
    bool depth_sampled = false;  // the sea's depth is a picture, not this pass's
layout(binding = slot_sea_depths) uniform sampler2DArray sea_depths;

layout(location = 0) out vec4 shown;

void main() {
  vec4 lit = solid_light();
  if (depth_sampled && gl_FragCoord.z <= texelFetch(sea_depths, ivec3(gl_FragCoord.xy, eye_index()), 0).r) discard;
  if (tile_shape) lit.rgb = tone_map(lit.rgb);
  shown = vec4(min(lit.rgb, vec3(6e4)), blends ? lit.a : 1.0);
}
