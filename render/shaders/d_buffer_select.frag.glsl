#version 450 core
// First pass of shading: visibility where no entry applies, and a depth of 1 where the second pass has to look at one.
// Software rasterisers run both sides of a branch, so the few pixels that need the long shader are told apart by depth.
#include "disk_area.glsl"
#include "d_buffer_lookup.glsl"

layout(location = 0) out float visibility;

void main() {
  Receiver r = receiver_at(ivec2(gl_FragCoord.xy));
  Texel t = texel_of(r.x);
  float open = half_plane_area(chord_of_plane(r.n, r.x, radius).delta);
  bool hidden = r.cut < 1.0;
  bool open_to_entries = r.face != 0u && r.x.z > 0.0 && open > 0.0 && t.at.z >= 0;
  bool applies = open_to_entries && texelFetch(first_entry, layer_of(kind_of_entries(hidden, r, t), t), 0).r != kEmpty;
  visibility = r.face == 0u ? 1.0 : r.x.z <= 0.0 ? 0.0 : open_to_entries && hidden ? 0.0 : open;
  gl_FragDepth = applies ? 1.0 : 0.0;
}
