#version 450 core
// D-buffer step 6: what a texel keeps of an entry. That is 1 + its facet or, for the 2004 paper's own contents, the
// bits of the height of its edge; the depth test keeps its depth.
//
// Defined from outside (fill_passes.cpp):
//   SURFACE  0: every entry is kept; 1: those in front of the surface; 2: those behind it
//   PEEL     1: only entries after the one that is kept already, for a second one a texel

uniform bool store_edge_height;

flat in uint entry_facet;
in float entry_edge_height;
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
  entry = store_edge_height ? floatBitsToUint(entry_edge_height) : entry_facet + 1u;
}
