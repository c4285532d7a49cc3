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
  const ViewData view = frame.view[eye_index()];
  bool dry = false;
  if (air_pockets + portals > 0)
    dry = ends_in_air(pixel_ray, view);
  else if (frame.shown.y != eyes_in_water)
    dry = over_horizon(pixel_ray, view) >= -view.eye.w;  // at the horizon where they begin says it (near_side.frag)
  if (dry) discard;
}
