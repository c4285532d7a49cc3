#version 460
// Black, for no eye sees it.
layout(location = 0) out vec4 colour;

void main() { colour = vec4(0.0, 0.0, 0.0, 1.0); }
