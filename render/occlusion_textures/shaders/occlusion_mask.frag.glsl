#version 450 core
// Occlusion textures, step 2: depth → the channel of its slice (and of the next one), joined to what is there by a bitwise
// OR. "Occlusion textures" (2006), section 3.4.

in float depth;  // in slices from the first on
flat in int sample_number;

uniform int slice_count;
uniform int samples;     // 1, or 8: one bit each
uniform bool fills_next;  // draw into the next slice too

layout(location = 0) out vec4 masks[4];

void main() {
  // What lies in a plane belongs to the slice that ends there, within a ten-thousandth of a slice. Outside of the slices
  // there is nothing that lies between a receiver and the light.
  if (depth < -1e-4 || depth > float(slice_count) + 1e-4) discard;
  int slice = clamp(int(ceil(depth - 1e-4)) - 1, 0, slice_count - 1);
  float bits = samples == 1 ? 1.0 : float(1 << sample_number) / 255.0;
  for (int t = 0; t < 4; ++t) {
    ivec4 number = 4 * t + ivec4(0, 1, 2, 3);
    vec4 own = vec4(equal(number, ivec4(slice))), next = vec4(equal(number, ivec4(slice + 1)));
    masks[t] = bits * (fills_next ? own + next : own);
  }
}
