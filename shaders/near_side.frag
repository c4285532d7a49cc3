#version 460
// Lines of sight that begin in the water and end so near the horizon that the last triangles of the sea may miss them:
// they end where they begin.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
#include "lib/sea_light.glsl"
#include "lib/line_clip.glsl"

layout(location = 0) in vec3 line_of_sight;
layout(location = 1) in vec3 line_at;

void main() {
  const ViewData view = frame.view[eye_index()];
  if (abs(over_horizon(line_of_sight, view)) > view.eye.w || line_is_dry(line_at)) discard;
}
