#version 460
// A limb of a hand: a half sphere, a cone and a half sphere.
#extension GL_GOOGLE_include_directive : require
#include "shared/frame_data.h"
#include "shared/hand_limb.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };

layout(location = 0) in vec4 limb_from;  // HandLimb
layout(location = 1) in vec4 limb_to;
layout(location = 2) in vec4 limb_colour;

layout(location = 0) out vec3 normal;
layout(location = 1) out vec3 to_eye;
layout(location = 2) flat out vec4 colour;
layout(location = 3) flat out vec3 axis;

void main() {
  const int quad = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
  const int ring = quad / limb_sides + ((corner == 1 || corner == 3 || corner == 4) ? 1 : 0),
            side = quad % limb_sides + ((corner == 2 || corner == 4 || corner == 5) ? 1 : 0);
  // Four rings of each half, the limb's length between the middle two.
  const bool far_end = ring > limb_rings / 2;
  const float up = radians(30.0) * float(far_end ? ring - 4 : ring - 3),
              about = radians(360.0) * float(side) / limb_sides;
  const vec3 along = limb_to.xyz - limb_from.xyz;
  axis = along / max(length(along), 1e-6);
  const vec3 across = normalize(abs(axis.y) < 0.9 ? vec3(-axis.z, 0.0, axis.x) : vec3(axis.y, -axis.x, 0.0));
  normal = sin(up) * axis + cos(up) * (cos(about) * across + sin(about) * cross(axis, across));
  const vec4 end = far_end ? limb_to : limb_from;
  const vec3 place = end.xyz + end.w * normal;
  const ViewData view = frame.view[eye_index()];
  to_eye = view.eye.xyz - place;
  colour = limb_colour;
  gl_Position = view.clip_from_relative * vec4(place, 1.0);
}
