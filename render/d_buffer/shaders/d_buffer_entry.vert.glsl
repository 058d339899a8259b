#version 450 core
// D-buffer step 6: an entry's vertex (EntryVertex) on its way to one target.

layout(location = 0) in vec4 place;         // (u, v, h, 1) · a positive number, in light space
layout(location = 1) in uint facet;         // index of the facet's record
layout(location = 2) in float edge_height;  // h of the edge's point that this line of the facet starts from

uniform mat4 to_clip;

invariant gl_Position;  // two programs share these depths
flat out uint entry_facet;
out float entry_edge_height;

void main() {
  entry_facet = facet;
  entry_edge_height = edge_height;
  gl_Position = to_clip * place;
}
