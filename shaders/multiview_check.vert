#version 460
// A triangle that every side of the picture clips; its edge cuts the upper left corner off from (8, 0) to (0, 8) of 16
// pixels.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
layout(location = 0) flat out int eye;
void main() {
  eye = int(gl_ViewIndex);
  const vec2 corners[3] = vec2[](vec2(-5.0, 4.0), vec2(4.0, -5.0), vec2(9.0, 9.0));
  gl_Position = vec4(corners[gl_VertexIndex], 0.5, 1.0);
}
