#version 460
#extension GL_GOOGLE_include_directive : require
layout(location = 0) flat in int eye;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(eye == 0 ? 1.0 : 0.0, eye == 1 ? 1.0 : 0.0, 0.0, 1.0); }
