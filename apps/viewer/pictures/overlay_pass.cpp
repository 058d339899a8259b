#include "apps/viewer/pictures/overlay_pass.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>

#include "apps/viewer/pictures/cut.h"

namespace penumbra::viewer {
namespace {

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 to_clip;
uniform vec3 axis;    // unit vector along which things are cut
uniform vec3 eye;
uniform float nearer; // parts of the way to the eye
uniform vec2 shift;   // in clip units
out vec4 shade;
out float along;
void main() {
  gl_Position = to_clip * vec4(position, 1.0);
  if (nearer > 0.0) {  // the same place in the picture
    vec4 moved = to_clip * vec4(mix(position, eye, nearer), 1.0);
    gl_Position.z = moved.z / moved.w * gl_Position.w;
  }
  gl_Position.xy += shift * gl_Position.w;
  shade = color;
  along = dot(axis, position);
}
)";

constexpr const char* kFragmentShader = R"(#version 450 core
in vec4 shade;
in float along;
uniform float cut;
out vec4 color;
void main() {
  if (along > cut) discard;
  color = shade;
}
)";

constexpr VertexAttribute kColor{4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(OverlayVertex, color)};

}  // namespace

OverlayPass::OverlayPass(const gl::Functions& gl)
    : gl_(gl),
      program_(gl, {{GL_VERTEX_SHADER, "overlay.vert", kVertexShader},
                    {GL_FRAGMENT_SHADER, "overlay.frag", kFragmentShader}}),
      scene_(gl),
      faces_(gl),
      lines_(gl),
      sheets_(gl) {}

void OverlayPass::set(std::shared_ptr<const OverlayGeometry> geometry) {
  if (geometry == geometry_) return;
  geometry_ = std::move(geometry);
  if (!geometry_) return;
  scene_.count = upload(gl_, scene_, geometry_->scene, kColor);
  faces_.count = upload(gl_, faces_, geometry_->faces, kColor);
  lines_.count = upload(gl_, lines_, geometry_->lines, kColor);
  sheets_.count = upload(gl_, sheets_, geometry_->sheets, kColor);
}

void OverlayPass::draw_list(const VertexList& list, GLenum mode) const {
  if (!list.count) return;
  gl_.BindVertexArray(list.array);
  gl_.DrawArrays(mode, 0, list.count);
}

void OverlayPass::draw(const State& state, const Viewport& place) const {
  if (!geometry_) return;
  const OverlayGeometry& g = *geometry_;
  // Everything relative to g.origin, so that float is enough.
  Camera camera = state.camera;
  camera.eye -= g.origin;
  camera.target -= g.origin;
  const double distance = glm::length(camera.eye), far = distance + 3.0 * g.bound;
  const double near = std::max(1e-3 * g.bound, distance - 3.0 * g.bound);
  const std::array<float, 16> matrix = Projection(camera, place.width, place.height).clip_matrix(near, far);
  const Cut cut = cut_of(state, g);
  gl_.Viewport(0, place.bottom, place.width, place.height);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.DepthMask(GL_TRUE);
  const float furthest = 1.0f;
  gl_.ClearBufferfv(GL_DEPTH, 0, &furthest);
  program_.use();
  gl_.UniformMatrix4fv(program_.uniform("to_clip"), 1, GL_FALSE, matrix.data());
  gl_.Uniform3f(program_.uniform("axis"), static_cast<float>(cut.axis.x), static_cast<float>(cut.axis.y),
                static_cast<float>(cut.axis.z));
  gl_.Uniform3f(program_.uniform("eye"), static_cast<float>(camera.eye.x), static_cast<float>(camera.eye.y),
                static_cast<float>(camera.eye.z));
  gl_.Uniform1f(program_.uniform("nearer"), 0.0f);
  gl_.Uniform2f(program_.uniform("shift"), 0.0f, 0.0f);
  gl_.Uniform1f(program_.uniform("cut"), 3e38f);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_list(scene_, GL_TRIANGLES);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.DepthMask(GL_FALSE);
  gl_.Uniform1f(program_.uniform("nearer"), 2e-4f);
  draw_list(faces_, GL_TRIANGLES);
  gl_.Uniform1f(program_.uniform("cut"), static_cast<float>(cut.most));
  draw_list(sheets_, GL_TRIANGLES);
  gl_.Uniform1f(program_.uniform("cut"), 3e38f);
  gl_.Uniform1f(program_.uniform("nearer"), 2e-3f);
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {0, 1}}) {  // core OpenGL draws lines one pixel wide
    gl_.Uniform2f(program_.uniform("shift"), 2.0f * static_cast<float>(x) / static_cast<float>(place.width),
                  2.0f * static_cast<float>(y) / static_cast<float>(place.height));
    draw_list(lines_, GL_LINES);
  }
  gl_.BindVertexArray(0);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_DEPTH_TEST);
}

}  // namespace penumbra::viewer
