#version 460
// A corner of a solid thing as the sun sees it, over the still sea laid flat.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/solid_data.h"

layout(binding = slot_frame) uniform Frame { FrameData frame; };

layout(location = 0) in vec4 corner_place;  // SolidVertex
layout(location = 2) in vec4 corner_uv;
layout(location = 3) in vec4 corner_colour;
layout(location = 4) in vec4 row_x;  // SolidInstance
layout(location = 5) in vec4 row_y;
layout(location = 6) in vec4 row_z;

layout(location = 0) out vec4 uv;
layout(location = 1) out float alpha;

void main() {
  const vec4 from = vec4(corner_place.xyz, 1.0);
  const vec4 on_sea = vec4(dot(row_x, from), dot(row_y, from), dot(row_z, from), 1.0);
  uv = corner_uv;
  alpha = corner_colour.a;
  gl_Position = vec4(2.0 * dot(frame.sun_map_column, on_sea) - 1.0, 2.0 * dot(frame.sun_map_row, on_sea) - 1.0,
                     dot(frame.sun_map_near, on_sea), 1.0);
}
