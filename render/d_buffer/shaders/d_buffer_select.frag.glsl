#version 450 core
// D-buffer step 7, first pass: visibility where no entry applies. Depth 1 marks pixels for the second pass, depth 0 all
// others: software rasterizers run both sides of a branch, so a branch would not spare the long shader.
//
// Defined from outside (visibility_pass.cpp):
//   TARGETS  number of targets
//   KNOWN    1: the visibility where no entry applies is in the image already
#include "disk_area.glsl"
#include "d_buffer_lookup.glsl"

#if !KNOWN
layout(location = 0) out float visibility;
#endif

void main() {
  Receiver r = receiver_at(ivec2(gl_FragCoord.xy));
  Texel t = texel_of(r.x);
  bool sees_some = r.n.z > -length(r.n.xy);  // of the disk above the horizon
  bool open_to_entries = r.face != 0u && !r.behind && sees_some && t.at.z >= 0;
  bool applies = open_to_entries && texelFetch(first_entry, layer_of(kind_of_entries(r, t), t), 0).r != kEmpty;
#if !KNOWN
  visibility = r.face == 0u ? 1.0 : r.behind || (open_to_entries && r.hidden)
                   ? 0.0
                   : half_plane_area(chord_of_plane(r.n).delta);
#endif
  gl_FragDepth = applies ? 1.0 : 0.0;
}
