#version 450 core
// D-buffer step 6: an entry's vertex (EntryVertex) on its way to one target.
#include "d_buffer_target.glsl"

layout(location = 0) in vec3 uvw;           // (x/z, y/z, 1/z) in the light's frame
layout(location = 1) in uint facet;         // index of the facet's record
layout(location = 2) in float edge_weight;  // 1/z of the edge's point that this line of the facet starts from

invariant gl_Position;  // two programs share these depths
flat out uint entry_facet;
out float entry_edge_weight;

void main() {
  entry_facet = facet;
  entry_edge_weight = edge_weight;
  gl_Position = target_position(vec3(uvw.xy, 1.0), uvw.z);
}
