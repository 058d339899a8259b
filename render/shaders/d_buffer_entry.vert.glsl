#version 450 core
#include "d_buffer_target.glsl"

layout(location = 0) in vec3 uvw;     // (x/z, y/z, 1/z) in the light's frame
layout(location = 1) in uint facet;   // index of the facet's record

flat out uint entry_facet;

void main() {
  entry_facet = facet;
  gl_Position = target_position(vec3(uvw.xy, 1.0), uvw.z);
}
