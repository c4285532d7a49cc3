#version 460
// One triangle over the whole picture, at the far end of reversed depth.
#extension GL_GOOGLE_include_directive : require
layout(location = 0) out vec2 device_xy;
void main() {
  device_xy = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(device_xy, 0.0, 1.0);
}
