#version 450 core
// What a texel keeps of an entry: which facet it is, or, for the 2004 paper's own contents, the depth of its edge. Entries
// may have to stand a comparison with a surface (SURFACE 1: lie in front of it; 2: behind it), or to come after an entry
// that is kept already (PEEL 1).

uniform bool store_edge_weight;

flat in uint entry_facet;
in float entry_edge_weight;
layout(location = 0) out uint entry;

#if SURFACE != 0
uniform int target;
uniform sampler2DArray surface_depth;

bool stands_surface() {
  float surface = texelFetch(surface_depth, ivec3(gl_FragCoord.xy, target), 0).r;
  return SURFACE == 1 ? gl_FragCoord.z > surface : gl_FragCoord.z <= surface;
}
#else
bool stands_surface() { return true; }
#endif

#if PEEL
uniform int layer;
uniform usampler2DArray first_entry;
uniform sampler2DArray first_depth;
uniform samplerBuffer records;

// Whether two facets are one, or neighbors at a corner: the visibility of the first knows of the second already.
bool linked(uint one, uint two) {
  uint previous = uint(texelFetch(records, int(4u * one)).w + 0.5);
  uint next = uint(texelFetch(records, int(4u * one) + 3).w + 0.5);
  return one == two || previous == two + 1u || next == two + 1u;
}

// By depth, then by number.
bool comes_after_first() {
  ivec3 at = ivec3(gl_FragCoord.xy, layer);
  uint first = texelFetch(first_entry, at, 0).r;
  if (first == 0u || linked(first - 1u, entry_facet)) return false;
  float depth = texelFetch(first_depth, at, 0).r;
  return gl_FragCoord.z < depth || (gl_FragCoord.z == depth && entry_facet + 1u > first);
}
#else
bool comes_after_first() { return true; }
#endif

void main() {
  if (!stands_surface() || !comes_after_first()) discard;
  entry = store_edge_weight ? floatBitsToUint(entry_edge_weight) : entry_facet + 1u;
}
