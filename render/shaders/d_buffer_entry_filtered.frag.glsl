#version 450 core
// The same, for entries that have to stand a comparison with a surface, or come after an entry that is kept already.

uniform bool store_edge_weight;
uniform int layer;
uniform int against;                 // 0: no comparison; 1: in front of the surface; 2: behind it
uniform sampler2DArray surface_depth;
uniform bool peel;                   // keep only what comes after the first entries, by depth, then by number
uniform usampler2DArray first_entry;
uniform sampler2DArray first_depth;
uniform samplerBuffer records;

flat in uint entry_facet;
in float entry_edge_weight;
layout(location = 0) out uint entry;

// Whether two facets are one, or neighbours at a corner: the visibility of the first knows of the second already.
bool linked(uint one, uint two) {
  uint previous = uint(texelFetch(records, int(4u * one)).w + 0.5);
  uint next = uint(texelFetch(records, int(4u * one) + 3).w + 0.5);
  return one == two || previous == two + 1u || next == two + 1u;
}

bool comes_after_first(ivec3 at) {
  uint first = texelFetch(first_entry, at, 0).r;
  if (first == 0u || linked(first - 1u, entry_facet)) return false;
  float depth = texelFetch(first_depth, at, 0).r;
  return gl_FragCoord.z < depth || (gl_FragCoord.z == depth && entry_facet + 1u > first);
}

void main() {
  ivec3 at = ivec3(gl_FragCoord.xy, layer);
  float surface = texelFetch(surface_depth, at, 0).r;
  if (against == 1 && gl_FragCoord.z <= surface || against == 2 && gl_FragCoord.z > surface) discard;
  if (peel && !comes_after_first(at)) discard;
  entry = store_edge_weight ? floatBitsToUint(entry_edge_weight) : entry_facet + 1u;
}
