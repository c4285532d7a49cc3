#version 460
// A bubble as a quad that stands across the line from the viewer's head, so that both eyes see the same one.
#extension GL_GOOGLE_include_directive : require
#include "shared/earth_curve.h"
#include "shared/frame_data.h"
#include "lib/view.glsl"

layout(binding = slot_frame) uniform Frame { FrameData frame; };

layout(location = 0) in vec4 bubble_place;  // BubbleInstance
layout(location = 1) in vec4 bubble_shape;

layout(location = 0) out vec2 at;  // across its outline, 1 at the edge
layout(location = 1) flat out vec3 middle;
layout(location = 2) flat out vec3 side;  // to the picture's right, as far as it reaches
layout(location = 3) flat out vec3 up;
layout(location = 4) flat out float flatness;

void main() {
  vec3 relative = curved(bubble_place.xz, bubble_place.y, frame.viewer.w);
  relative.y -= frame.viewer.z;
  const vec3 ahead = relative / max(length(relative), 1e-6);
  // Wide as it is, and as high as a body of turn is seen from this height: it lies flat on its way up.
  const float level = length(ahead.xz);
  const vec3 right = level > 1e-3 ? vec3(-ahead.z, 0.0, ahead.x) / level : vec3(1.0, 0.0, 0.0);
  flatness = bubble_shape.x * (1.0 + 0.15 * bubble_shape.z * sin(2.0 * bubble_shape.y));
  const float high = sqrt(flatness * flatness * level * level + ahead.y * ahead.y);
  side = bubble_place.w * right;
  up = bubble_place.w * high * cross(right, ahead);
  middle = relative;
  const int corner = gl_VertexIndex < 3 ? gl_VertexIndex : gl_VertexIndex - 2;  // 0 1 2, 1 2 3
  at = 1.1 * vec2((corner & 1) == 0 ? -1.0 : 1.0, corner < 2 ? -1.0 : 1.0);
  gl_Position = frame.view[eye_index()].clip_from_relative * vec4(relative + at.x * side + at.y * up, 1.0);
}
