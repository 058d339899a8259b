#version 450 core

flat in uint entry_facet;
layout(location = 0) out uint facet;

void main() { facet = entry_facet + 1u; }
