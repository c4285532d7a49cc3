#version 460
// One triangle over the whole picture, at the far end of reversed depth.
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 6) const bool needs_device_xy = true;
layout(location = 0) out vec2 device_xy;
void main() {
  const vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  if (needs_device_xy) device_xy = corner;
  gl_Position = vec4(corner, 0.0, 1.0);
}
