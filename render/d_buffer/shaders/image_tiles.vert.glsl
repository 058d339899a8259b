#version 450 core
// D-buffer step 7: a rectangle of the image (entries/tiles.h), at the depth that the second pass compares marks with.

layout(location = 0) in vec2 corner;  // clip coordinates

void main() { gl_Position = vec4(corner, 0.5, 1.0); }
