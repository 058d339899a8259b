#version 450 core
// Where a receiver's line to the light's center is cut, by the depth of the first surface in its texel. With the center
// below the horizon the texel says nothing.
#include "d_buffer_lookup.glsl"

layout(location = 0) out float free;

void main() {
  Receiver r = receiver_at(ivec2(gl_FragCoord.xy));
  Texel t = texel_of(r.x);
  uint face = texelFetch(occluder_face, t.at, 0).r;
  bool other = t.at.z >= 0 && dot(r.n, r.x) < 0.0 && face != kEmpty && face != r.face;
  float weight = weight_of(texelFetch(occluder_depth, t.at, 0).r, t);
  free = other && is_above(weight, r, t) ? r.weight / weight : 1.0;
}
