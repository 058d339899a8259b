#version 450 core
// Keeps only entries behind the last surface that the light's center sees on this line.

uniform sampler2DArray last_depth;
uniform int layer;

flat in uint entry_facet;
layout(location = 0) out uint facet;

void main() {
  if (gl_FragCoord.z > texelFetch(last_depth, ivec3(gl_FragCoord.xy, layer), 0).r) discard;
  facet = entry_facet + 1u;
}
