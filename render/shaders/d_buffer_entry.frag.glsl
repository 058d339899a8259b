#version 450 core
// What a texel keeps of an entry: which facet it is, or, for the 2004 paper's own contents, the depth of its edge.

uniform bool store_edge_weight;

flat in uint entry_facet;
in float entry_edge_weight;
layout(location = 0) out uint entry;

void main() { entry = store_edge_weight ? floatBitsToUint(entry_edge_weight) : entry_facet + 1u; }
