#version 450 core
// Occlusion textures, step 2: a caster's point as the center of projection behind the light sees it, once for each sample of
// a texel.

// A MaskVertex.
layout(location = 0) in vec4 clip;
layout(location = 1) in float slice;
layout(location = 2) in float in_front;

uniform float texels;  // a side
uniform int samples;

out float depth;       // in slices from the first on
flat out int sample_number;

// No two in one row or column of eighths.
const float kRows[8] = float[8](1.0, 4.0, 7.0, 2.0, 5.0, 0.0, 3.0, 6.0);

void main() {
  vec2 shift = samples == 1 ? vec2(0.0) : (vec2(gl_InstanceID, kRows[gl_InstanceID]) + 0.5) / 8.0 - 0.5;
  gl_ClipDistance[0] = in_front;  // nothing behind the light's plane casts
  gl_Position = vec4(clip.xy - 2.0 * shift / texels * clip.w, 0.5 * clip.w, clip.w);
  depth = slice;
  sample_number = gl_InstanceID;
}
