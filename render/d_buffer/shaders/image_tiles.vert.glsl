#version 450 core

layout(location = 0) in vec2 corner;  // clip coordinates

void main() { gl_Position = vec4(corner, 0.5, 1.0); }
