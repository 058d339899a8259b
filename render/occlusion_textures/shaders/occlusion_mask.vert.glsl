#version 450 core
// Occlusion textures, step 2: a caster's point as the center of projection behind the light sees it, once for each sample of
// a texel.

layout(location = 0) in vec3 position;  // caster frame

uniform mat3 light_axes;  // caster frame → light's frame
uniform vec3 light_offset;
uniform float near_depth;      // nothing nearer to the light's plane casts
uniform float narrowing;       // 1/distance of the center of projection behind the light
uniform vec2 window_middle;    // low + high
uniform vec2 window_size;      // high - low
uniform float texels;          // a side
uniform int samples;

out float depth;
flat out int sample_number;

// No two in one row or column of eighths.
const float kRows[8] = float[8](1.0, 4.0, 7.0, 2.0, 5.0, 0.0, 3.0, 6.0);

void main() {
  vec3 x = light_axes * position + light_offset;
  float w = 1.0 + narrowing * x.z;
  vec2 shift = samples == 1 ? vec2(0.0) : (vec2(gl_InstanceID, kRows[gl_InstanceID]) + 0.5) / 8.0 - 0.5;
  gl_ClipDistance[0] = x.z - near_depth;
  gl_Position = vec4((2.0 * x.xy - window_middle * w) / window_size - 2.0 * shift / texels * w, 0.5 * w, w);
  depth = x.z;
  sample_number = gl_InstanceID;
}
