#version 460
// A solid thing as it is above the water, for eyes in it to see through its surface (lib/solids_above.glsl).
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/solids_above.h"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
int eye_index() { return 0; }  // both eyes share the pictures: they have the light that goes to the first
#include "lib/solid_light.glsl"

layout(location = 0) out vec4 sent;  // a: one over the distance from the pictures' middle, 1/m

void main() {
  const vec3 lit = solid_light().rgb * exp2(-frame.air.y);
  sent = vec4(min(lit, vec3(6e4)), 1.0 / max(distance(relative, frame.solids.above.xyz), solids_above_near_m));
}
