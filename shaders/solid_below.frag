#version 460
// A solid thing as it is under water, for the surface to show (lib/solids_in_water.glsl).
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/solid_light.glsl"

layout(location = 0) out vec4 sent;

void main() {
  const vec3 lit = solid_in_water();
  // What stands above all water would hide what is under water behind it.
  if (flattened(relative + vec3(0.0, frame.viewer.z, 0.0), frame.viewer.w).y > frame.solids.reach.y) discard;
  sent = vec4(min(lit, vec3(6e4)), gl_FragCoord.z);
}
