// One target of the D-buffer: a perspective from the light's center, in the light's frame (disk in z = 0).

uniform mat3 target_axes;    // to (right, up, forward) of the target
uniform vec4 target_window;  // left, right, bottom, top at forward distance 1
uniform float near_depth;    // forward distance below which nothing is drawn

// Clip position of the point whose homogeneous coordinates are (direction, weight). The depth that is stored,
// near_depth · weight / forward, is linear on planes: reversed and float, so it keeps its digits far away.
vec4 target_position(vec3 direction, float weight) {
  vec3 d = target_axes * direction;
  vec2 middle = vec2(target_window.x + target_window.y, target_window.z + target_window.w);
  vec2 size = vec2(target_window.y - target_window.x, target_window.w - target_window.z);
  return vec4((2.0 * d.xy - middle * d.z) / size, near_depth * weight, d.z);
}
