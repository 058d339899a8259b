#version 450 core
// D-buffer step 5: a caster's vertex on its way to one target.

layout(location = 0) in vec4 place;  // (u, v, h, 1) · weight in light space

uniform mat4 to_clip;
uniform float near_weight;

void main() {
  gl_ClipDistance[0] = place.w - near_weight;  // nothing behind the light's plane casts
  gl_Position = to_clip * place;
}
