#version 450 core
// D-buffer step 1 without rays (CenterTest::kDepth): whether a receiver sees the light's center, by the depth of the
// first surface in its texel, as the 2004 paper does. A receiver whose horizon is above the center counts as seeing it.
// TARGETS: number of targets.
#include "d_buffer_lookup.glsl"

layout(location = 0) out float seen;

void main() {
  Receiver r = receiver_at(ivec2(gl_FragCoord.xy));
  Texel t = texel_of(r.x);
  uint face = texelFetch(occluder_face, t.at, 0).r;
  bool other = t.at.z >= 0 && r.n.z > 0.0 && face != kEmpty && face != r.face;
  float height = height_of(texelFetch(occluder_depth, t.at, 0).r, t);
  seen = other && !r.behind && is_above(height, r, t) ? 0.0 : 1.0;
}
