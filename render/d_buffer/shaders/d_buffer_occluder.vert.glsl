#version 450 core
#include "d_buffer_target.glsl"

layout(location = 0) in vec3 position;  // scene frame

uniform mat3 light_axes;    // scene frame → light's frame
uniform vec3 light_offset;

void main() {
  vec3 x = light_axes * position + light_offset;
  gl_ClipDistance[0] = x.z - near_depth;  // nothing behind the light's plane casts
  gl_Position = target_position(x, 1.0);
}
