#include "apps/viewer/pictures/solid_pass.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>

#include "apps/viewer/handles/projection.h"

namespace penumbra::viewer {
namespace {

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 to_clip;
uniform vec3 axis;  // unit vector along which things are cut
out vec3 place, across;
out float along;
void main() {
  gl_Position = to_clip * vec4(position, 1.0);
  place = position;
  across = normal;
  along = dot(axis, position);
}
)";

constexpr const char* kFragmentShader = R"(#version 450 core
in vec3 place, across;
in float along;
uniform vec3 eye, tint;
uniform float cut;
uniform float strength;  // of all of it, 0 to 1
uniform float flatness;  // 1: a section, equally dense everywhere
out vec4 color;
void main() {
  if (along > cut) discard;
  float facing = abs(dot(normalize(across), normalize(eye - place)));
  float edge = pow(1.0 - facing, 2.5);
  float density = mix(mix(0.13, 0.65, edge), 0.60, flatness);
  color = vec4(tint * mix(mix(0.80, 1.0, facing), 1.0, flatness), strength * density);
}
)";

constexpr VertexAttribute kNormal{3, GL_FLOAT, GL_FALSE, offsetof(SolidVertex, nx)};

}  // namespace

SolidPass::SolidPass(const gl::Functions& gl)
    : gl_(gl),
      program_(gl, {{GL_VERTEX_SHADER, "solid.vert", kVertexShader},
                    {GL_FRAGMENT_SHADER, "solid.frag", kFragmentShader}}),
      umbra_(gl),
      penumbra_(gl),
      section_(gl) {}

void SolidPass::set(std::shared_ptr<const Solids> solids) {
  if (solids == solids_) return;
  solids_ = std::move(solids);
  if (!solids_) return;
  const auto fill = [&](VertexList& list, const std::optional<std::vector<SolidVertex>>& vertices) {
    list.count = vertices ? upload(gl_, list, *vertices, kNormal) : 0;
  };
  fill(umbra_, solids_->umbra);
  fill(penumbra_, solids_->penumbra);
}

void SolidPass::set_tint(const OverlayColor& c) const {
  gl_.Uniform3f(program_.uniform("tint"), static_cast<float>(c.r) / 255.0f, static_cast<float>(c.g) / 255.0f,
                static_cast<float>(c.b) / 255.0f);
}

// A square in the plane of the cut, large enough for everything.
void SolidPass::set_section(const Cut& cut, const Vec3& origin, double bound) const {
  const Vec3 hint = std::abs(cut.axis.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  const Vec3 u = 3.0 * bound * glm::normalize(glm::cross(cut.axis, hint)), v = glm::cross(cut.axis, u);
  const Vec3 middle = (cut.most - glm::dot(origin, cut.axis)) * cut.axis + origin;
  std::vector<SolidVertex> square;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}}) {
    const Vec3 p = middle + double(x) * u + double(y) * v;
    const auto n = cut.axis;
    square.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                      static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
  }
  upload(gl_, section_, square, kNormal);
}

void SolidPass::draw_surface(const Glass& glass, GLenum culled) const {
  gl_.Enable(GL_CULL_FACE);
  gl_.CullFace(culled);
  set_tint(glass.color);
  gl_.BindVertexArray(glass.list.array);
  gl_.DrawArrays(GL_TRIANGLES, 0, glass.list.count);
  gl_.Disable(GL_CULL_FACE);
}

// What is left of a closed surface shows as many front faces as back faces along a line, unless the line
// crosses the cut inside of it: the stencil counts the difference, and the square is drawn where it is not 0.
void SolidPass::draw_section(const Glass& glass, float cut) const {
  gl_.Enable(GL_STENCIL_TEST);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.StencilFunc(GL_ALWAYS, 0, 0xFF);
  gl_.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
  gl_.StencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
  gl_.BindVertexArray(glass.list.array);
  gl_.DrawArrays(GL_TRIANGLES, 0, glass.list.count);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.StencilFunc(GL_NOTEQUAL, 0, 0xFF);
  gl_.StencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, GL_KEEP);
  gl_.Uniform1f(program_.uniform("flatness"), 1.0f);
  set_tint(glass.color);
  gl_.Uniform1f(program_.uniform("cut"), 3e38f);  // the square lies in the cut
  gl_.BindVertexArray(section_.array);
  gl_.DrawArrays(GL_TRIANGLES, 0, 6);
  gl_.Uniform1f(program_.uniform("cut"), cut);
  gl_.Uniform1f(program_.uniform("flatness"), 0.0f);
  const GLint nothing = 0;
  gl_.ClearBufferiv(GL_STENCIL, 0, &nothing);
  gl_.Disable(GL_STENCIL_TEST);
}

void SolidPass::draw(const State& state, const OverlayGeometry& g, const Viewport& place, bool faint) const {
  if (!solids_) return;
  // Everything relative to the solids' origin, so that float is enough.
  Camera camera = state.camera;
  camera.eye -= solids_->origin;
  camera.target -= solids_->origin;
  // The same depths as OverlayPass has.
  const double distance = glm::length(state.camera.eye - g.origin), far = distance + 3.0 * g.bound;
  const double near = std::max(1e-3 * g.bound, distance - 3.0 * g.bound);
  const std::array<float, 16> matrix = Projection(camera, place.width, place.height).clip_matrix(near, far);
  Cut cut = cut_of(state, g);
  cut.most -= glm::dot(solids_->origin - g.origin, cut.axis);
  const auto set_vector = [&](const char* name, const Vec3& v) {
    gl_.Uniform3f(program_.uniform(name), static_cast<float>(v.x), static_cast<float>(v.y),
                  static_cast<float>(v.z));
  };
  if (cut.cuts) set_section(cut, g.origin - solids_->origin, g.bound);
  gl_.Viewport(0, place.bottom, place.width, place.height);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.DepthMask(GL_FALSE);
  program_.use();
  gl_.UniformMatrix4fv(program_.uniform("to_clip"), 1, GL_FALSE, matrix.data());
  set_vector("axis", cut.axis);
  set_vector("eye", camera.eye);
  gl_.Uniform1f(program_.uniform("cut"), cut.cuts ? static_cast<float>(cut.most) : 3e38f);
  gl_.Uniform1f(program_.uniform("strength"), faint ? 0.35f : 1.0f);
  gl_.Uniform1f(program_.uniform("flatness"), 0.0f);
  // The umbra lies inside of the penumbra: from the back to the front.
  const Overlays& o = state.overlays;
  const Glass penumbra{penumbra_, kPenumbraColor, o.penumbra_solid && penumbra_.count > 0};
  const Glass umbra{umbra_, kUmbraColor, o.umbra_solid && umbra_.count > 0};
  const bool section_in_front = cut.cuts && glm::dot(cut.axis, camera.eye) > cut.most;
  const auto sections = [&] {
    for (const Glass* each : {&penumbra, &umbra})
      if (each->shown) draw_section(*each, static_cast<float>(cut.most));
  };
  if (cut.cuts && !section_in_front) sections();
  if (penumbra.shown) draw_surface(penumbra, GL_FRONT);
  if (umbra.shown) draw_surface(umbra, GL_FRONT);
  if (umbra.shown) draw_surface(umbra, GL_BACK);
  if (section_in_front) sections();
  if (penumbra.shown) draw_surface(penumbra, GL_BACK);
  gl_.BindVertexArray(0);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_DEPTH_TEST);
}

}  // namespace penumbra::viewer
