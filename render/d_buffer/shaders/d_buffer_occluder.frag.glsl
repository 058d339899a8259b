#version 450 core
// D-buffer step 5: the number of the face; the depth test keeps its depth.

uniform uint first_face;  // ids are stored plus one, 0 is an empty texel
layout(location = 0) out uint face;

void main() { face = first_face + uint(gl_PrimitiveID) + 1u; }
