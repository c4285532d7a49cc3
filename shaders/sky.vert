#version 460
// One triangle over the whole picture, at the far end of reversed depth.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };
layout(constant_id = value_sky_ray) const bool needs_ray = true;
layout(location = 0) out vec3 pixel_ray;  // of the pixel, world axes, not of unit length

void main() {
  const vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  if (needs_ray) {
    const ViewData view = frame.view[eye_index()];
    pixel_ray = corner.x * view.ray_x.xyz + corner.y * view.ray_y.xyz + view.ray_z.xyz;
  }
  gl_Position = vec4(corner, 0.0, 1.0);
}
