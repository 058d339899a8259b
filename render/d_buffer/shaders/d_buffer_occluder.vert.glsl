#version 450 core
// D-buffer step 5: a caster's vertex on its way to one target.
#include "d_buffer_target.glsl"

layout(location = 0) in vec3 position;  // caster frame

uniform mat3 light_axes;    // caster frame → light's frame
uniform vec3 light_offset;

void main() {
  vec3 x = light_axes * position + light_offset;
  gl_ClipDistance[0] = x.z - near_depth;  // nothing behind the light's plane casts
  gl_Position = target_position(x, 1.0);
}
