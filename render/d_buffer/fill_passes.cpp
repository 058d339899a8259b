#include "render/d_buffer/fill_passes.h"

#include <cstddef>
#include <glm/mat4x4.hpp>

namespace penumbra::detail {
namespace {

using gl::Object;
constexpr GLuint kNoId[4] = {0, 0, 0, 0};

template <class T>
void fill(const gl::Functions& gl, GLenum kind, const Object& buffer, const std::vector<T>& data,
          GLenum usage) {
  gl.BindBuffer(kind, buffer);
  gl.BufferData(kind, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), usage);
}

/// (u, v, h, 1) · weight → clip coordinates. The depth, depth_scale · h · weight / forward, is linear on
/// planes; reversed and float, it keeps its digits where receivers are.
glm::dmat4 clip_matrix(const Target& target, double depth_scale) {
  const auto& [left, right, bottom, top] = target.window;
  glm::dmat4 out(0.0);
  for (const int k : {0, 1, 2}) {
    const int column = k < 2 ? k : 3;  // the target's axes are of u, v and the weight
    const double forward = target.axes[k][2];
    out[column][0] = (2.0 * target.axes[k][0] - (left + right) * forward) / (right - left);
    out[column][1] = (2.0 * target.axes[k][1] - (bottom + top) * forward) / (top - bottom);
    out[column][3] = forward;
  }
  out[2][2] = depth_scale;
  return out;
}

/// Whether penumbra entries are kept only in front of the first surface. That need not be tested for the
/// nearest ones where rays tell which receivers see the light's center: such a receiver lies on or before the
/// first surface, so the nearest entry before it is before the surface too.
bool needs_first_surface(const DBufferOptions& options) {
  return options.center == CenterTest::kDepth || options.conflict == Conflict::kFurthest;
}

}  // namespace

FillPasses::FillPasses(const gl::Functions& gl)
    : gl_(gl),
      occluder_program_(gl, {{GL_VERTEX_SHADER, "d_buffer_occluder.vert.glsl"},
                             {GL_FRAGMENT_SHADER, "d_buffer_occluder.frag.glsl"}}),
      caster_points_(gl, Object::Kind::kBuffer),
      caster_indices_(gl, Object::Kind::kBuffer),
      read_indices_(gl, Object::Kind::kBuffer),
      caster_array_(gl, Object::Kind::kVertexArray),
      penumbra_vertices_(gl, Object::Kind::kBuffer),
      umbra_vertices_(gl, Object::Kind::kBuffer),
      entry_array_(gl, Object::Kind::kVertexArray),
      record_buffer_(gl, Object::Kind::kBuffer),
      record_texture_(gl, Object::Kind::kTexture) {}

void FillPasses::upload_casters(CasterTriangles casters) {
  casters_ = std::move(casters);
  gl_.BindVertexArray(caster_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, caster_points_);
  fill(gl_, GL_ELEMENT_ARRAY_BUFFER, caster_indices_, casters_.indices, GL_STATIC_DRAW);
  gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(glm::vec4), nullptr);
  gl_.EnableVertexAttribArray(0);
}

void FillPasses::upload_points(std::vector<glm::vec4> points) {
  points_ = std::move(points);
  fill(gl_, GL_ARRAY_BUFFER, caster_points_, points_, GL_STREAM_DRAW);
}

void FillPasses::upload_entries(const EntryGeometry& geometry) {
  fill(gl_, GL_ARRAY_BUFFER, penumbra_vertices_, geometry.penumbra, GL_STREAM_DRAW);
  fill(gl_, GL_ARRAY_BUFFER, umbra_vertices_, geometry.umbra, GL_STREAM_DRAW);
  fill(gl_, GL_TEXTURE_BUFFER, record_buffer_, geometry.records, GL_STREAM_DRAW);
  gl_.BindTexture(GL_TEXTURE_BUFFER, record_texture_);
  gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, record_buffer_);
  penumbra_count_ = geometry.penumbra.size();
  umbra_count_ = geometry.umbra.size();
}

void FillPasses::set_target(const gl::Program& program, const Target& target, const DBufferView& view) const {
  const glm::mat4 to_clip(clip_matrix(target, view.depth_scale));
  gl_.UniformMatrix4fv(program.uniform("to_clip"), 1, GL_FALSE, &to_clip[0][0]);
}

void FillPasses::attach(const Layer& layer, int index) const {
  gl_.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layer.id.texture, 0, index);
  gl_.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layer.depth.texture, 0, index);
  const GLenum color = GL_COLOR_ATTACHMENT0;
  gl_.DrawBuffers(1, &color);
}

void FillPasses::bind(int unit, GLenum kind, GLuint texture) const {
  gl_.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  gl_.BindTexture(kind, texture);
}

/// Every caster that can occlude; only faces towards the light's center, where a caster shows no others.
void FillPasses::draw_casters(const Target& target, const DBufferView& view) {
  set_target(occluder_program_, target, view);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, caster_indices_);
  for (const CasterRange& caster : casters_.ranges) {
    if (caster.cannot_occlude) continue;
    if (caster.shows_only_fronts) gl_.Enable(GL_CULL_FACE);
    gl_.Uniform1ui(occluder_program_.uniform("first_face"), caster.first_face);
    const auto* first = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(caster.first_index) *
                                                      sizeof(std::uint32_t));
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(caster.index_count), GL_UNSIGNED_INT, first);
    gl_.Disable(GL_CULL_FACE);
  }
}

/// Only triangles that a receiver will read.
void FillPasses::draw_read_casters(const Target& target, const DBufferView& view,
                                   const ReceiverGrid& receivers) {
  set_target(occluder_program_, target, view);
  const ReadTriangles read = triangles_before_hidden(casters_, view, points_, receivers);
  if (!read.more.empty()) {
    points_.insert(points_.end(), read.more.begin(), read.more.end());
    fill(gl_, GL_ARRAY_BUFFER, caster_points_, points_, GL_STREAM_DRAW);
  }
  fill(gl_, GL_ELEMENT_ARRAY_BUFFER, read_indices_, read.indices, GL_STREAM_DRAW);
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(read.indices.size()), GL_UNSIGNED_INT, nullptr);
}

/// The first surface of all; then the last of those that face the light's center.
void FillPasses::draw_occluders(const DBufferView& view, const ReceiverGrid& receivers,
                                const DBufferLayers& layers, const DBufferOptions& options) {
  occluder_program_.use();
  gl_.Uniform1f(occluder_program_.uniform("near_weight"), static_cast<float>(LightSpace::kNearWeight));
  gl_.BindVertexArray(caster_array_);
  gl_.Enable(GL_CLIP_DISTANCE0);
  gl_.CullFace(GL_FRONT);  // targets look along right × up, which turns windings over
  const float farthest = 0.0f, nearest = 1.0f;
  for (std::size_t i = 0; i < view.targets.size(); ++i) {
    if (needs_first_surface(options)) {
      attach(layers.occluder, static_cast<int>(i));
      gl_.ClearBufferuiv(GL_COLOR, 0, kNoId);
      gl_.ClearBufferfv(GL_DEPTH, 0, &farthest);
      draw_casters(view.targets[i], view);
    }
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    gl_.FramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, layers.last.texture, 0,
                                static_cast<int>(i));
    gl_.ClearBufferfv(GL_DEPTH, 0, &nearest);
    gl_.DepthFunc(GL_LESS);
    if (receivers.is_everywhere())
      draw_casters(view.targets[i], view);
    else
      draw_read_casters(view.targets[i], view, receivers);
    gl_.DepthFunc(GL_GREATER);
  }
  gl_.Disable(GL_CLIP_DISTANCE0);
}

void FillPasses::draw_entries(const DBufferView& view, const DBufferLayers& layers,
                              const DBufferOptions& options) {
  gl_.BindVertexArray(entry_array_);
  const Entries penumbra{penumbra_vertices_, penumbra_count_}, umbra{umbra_vertices_, umbra_count_};
  draw_kind(view, layers, EntryKind::kPenumbra, penumbra,
            needs_first_surface(options) ? Against::kBeforeFirst : Against::kNothing, options);
  draw_kind(view, layers, EntryKind::kAbove, umbra, Against::kBeforeLast, options);
  draw_kind(view, layers, EntryKind::kBelow, umbra, Against::kBehindLast, options);
}

void FillPasses::draw_kind(const DBufferView& view, const DBufferLayers& layers, EntryKind kind,
                           const Entries& entries, Against against, const DBufferOptions& options) {
  constexpr auto kStride = sizeof(EntryVertex);
  gl_.BindBuffer(GL_ARRAY_BUFFER, entries.vertices);
  gl_.VertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, kStride, nullptr);
  gl_.VertexAttribIPointer(1, 1, GL_UNSIGNED_INT, kStride,
                           reinterpret_cast<const void*>(offsetof(EntryVertex, facet)));
  gl_.VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, kStride,
                          reinterpret_cast<const void*>(offsetof(EntryVertex, edge_height)));
  for (GLuint attribute : {0u, 1u, 2u}) gl_.EnableVertexAttribArray(attribute);
  draw_layer(view, layers, kind, false, entries, against, options);
  if (layers.entries > 1) draw_layer(view, layers, kind, true, entries, against, options);
}

const gl::Program& FillPasses::entry_program(int surface, bool peel) {
  std::unique_ptr<gl::Program>& program = entry_programs_[surface][peel];
  if (!program)
    program = std::make_unique<gl::Program>(
        gl_,
        std::initializer_list<gl::Program::Stage>{{GL_VERTEX_SHADER, "d_buffer_entry.vert.glsl"},
                                                  {GL_FRAGMENT_SHADER, "d_buffer_entry.frag.glsl"}},
        std::initializer_list<gl::Program::Definition>{{"SURFACE", surface}, {"PEEL", peel}});
  return *program;
}

void FillPasses::bind_filter(const gl::Program& program, const Layers& surface, const Layer& first) const {
  bind(0, GL_TEXTURE_2D_ARRAY, surface.texture);
  bind(1, GL_TEXTURE_2D_ARRAY, first.id.texture);
  bind(2, GL_TEXTURE_2D_ARRAY, first.depth.texture);
  bind(3, GL_TEXTURE_BUFFER, record_texture_);
  gl_.Uniform1i(program.uniform("surface_depth"), 0);
  gl_.Uniform1i(program.uniform("first_entry"), 1);
  gl_.Uniform1i(program.uniform("first_depth"), 2);
  gl_.Uniform1i(program.uniform("records"), 3);
  gl_.ActiveTexture(GL_TEXTURE0);
}

/// The nearest (or furthest) entries of one kind, or the nearest that come after those.
void FillPasses::draw_layer(const DBufferView& view, const DBufferLayers& layers, EntryKind kind, bool second,
                            const Entries& entries, Against against, const DBufferOptions& options) {
  const Layer& into = second ? layers.second_entries : layers.first_entries;
  const bool furthest = options.conflict == Conflict::kFurthest;
  const Layers& surface = against == Against::kBeforeFirst ? layers.occluder.depth : layers.last;
  // Nearest in front of a surface needs no comparison: the layer starts with the surface's depth.
  const bool in_front = against == Against::kBeforeFirst || against == Against::kBeforeLast;
  const bool starts_with_surface = in_front && !furthest && !second;
  const int compared = against == Against::kBehindLast ? 2 : in_front && !starts_with_surface ? 1 : 0;
  const gl::Program& program = entry_program(compared, second);
  program.use();
  gl_.Uniform1i(program.uniform("store_edge_height"), options.contents == DBufferContents::kDistances);
  bind_filter(program, surface, layers.first_entries);
  if (starts_with_surface)
    gl_.CopyImageSubData(surface.texture, GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, into.depth.texture,
                         GL_TEXTURE_2D_ARRAY, 0, 0, 0, layers.layer_of(kind, 0), layers.size, layers.size,
                         layers.count);
  gl_.DepthFunc(furthest ? GL_LESS : GL_GREATER);
  const float start = furthest ? 1.0f : 0.0f;
  for (int i = 0; i < static_cast<int>(view.targets.size()); ++i) {
    const int layer = layers.layer_of(kind, i);
    attach(into, layer);
    gl_.ClearBufferuiv(GL_COLOR, 0, kNoId);
    if (!starts_with_surface) gl_.ClearBufferfv(GL_DEPTH, 0, &start);
    gl_.Uniform1i(program.uniform("target"), i);
    gl_.Uniform1i(program.uniform("layer"), layer);
    set_target(program, view.targets[static_cast<std::size_t>(i)], view);
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(entries.count));
  }
  gl_.DepthFunc(GL_GREATER);
}

}  // namespace penumbra::detail
