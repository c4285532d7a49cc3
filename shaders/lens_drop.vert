#version 460
// A drop on an eye's lens: a quad just behind the near plane.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };

layout(location = 0) in vec4 drop_place;  // LensDrop
layout(location = 1) in vec4 drop_shape;

layout(location = 0) out vec2 at;             // in radii, along the way that it runs and across
layout(location = 1) out vec3 line_of_sight;  // on the plane at distance 1
layout(location = 2) flat out vec3 along;     // in the world, of unit length
layout(location = 3) flat out vec3 across;
layout(location = 4) flat out vec2 look;  // how far it is drawn out, in radii; how much of it is there

void main() {
  const ViewData view = frame.view[eye_index()];
  const mat4 clip = view.clip_from_relative;
  const vec3 ahead = normalize(vec3(clip[0].w, clip[1].w, clip[2].w)), right = normalize(view.ray_x.xyz),
             up = cross(right, ahead);
  const float radius = drop_place.z, drawn_out = length(drop_shape.xy);
  const vec2 way = drawn_out > 1e-6 ? drop_shape.xy / drawn_out : vec2(0.0, 1.0);
  along = way.x * right + way.y * up;
  across = way.y * right - way.x * up;
  look = vec2(drawn_out / radius, drop_shape.z);
  const int corner = gl_VertexIndex < 3 ? gl_VertexIndex : gl_VertexIndex - 2;  // 0 1 2, 1 2 3
  at = vec2((corner & 1) == 0 ? -1.0 : 1.0 + look.x, corner < 2 ? -1.0 : 1.0);
  line_of_sight = ahead + drop_place.x * right + drop_place.y * up + radius * (at.x * along + at.y * across);
  gl_Position = int(drop_place.w) != eye_index()
                    ? vec4(0.0, 0.0, -1.0, 1.0)
                    : clip * vec4(view.eye.xyz + 1.00002 * frame.air.z * line_of_sight, 1.0);
}
