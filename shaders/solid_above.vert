#version 460
// A corner of a solid thing in the pictures of what stands above the water (lib/solids_above.glsl).
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/solids_above.h"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/solid_corner.glsl"

layout(location = 7) in vec4 picture;  // SolidInstance

void main() {
  place_corner();
  const int side = int(picture.x);
  const vec4 clip = clip_above(relative - frame.solids.above.xyz, side);
  // Nothing reaches into the picture beside its own.
  gl_ClipDistance[0] = clip.w + clip.x;
  gl_ClipDistance[1] = clip.w - clip.x;
  gl_Position = clip_in_row_above(clip, side);
}
