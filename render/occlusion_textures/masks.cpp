#include "render/occlusion_textures/masks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace penumbra::detail {
namespace {

using gl::Object;
/// Accuracy: samples a texel for SliceCoverage::kArea; one bit each of a byte.
constexpr int kAreaSamples = 8;

/// What a texel's byte stands for: one bit a sample.
std::uint8_t coverage_of(std::uint8_t bits, bool area) {
  return area ? static_cast<std::uint8_t>((std::popcount(bits) * 255 + kAreaSamples / 2) / kAreaSamples)
              : bits;
}

}  // namespace

MaskGeometry mask_geometry(const std::vector<const TriangleMesh*>& meshes,
                           const std::vector<CasterExtent>& extents, const SliceSpace& space,
                           const SliceFrustum& frustum) {
  const glm::dvec2 middle = frustum.low + frustum.high, size = frustum.high - frustum.low;
  MaskGeometry out;
  const auto add = [&](const Vec3& p) {
    const double weight = frustum.weight(p.z);
    const glm::dvec2 clip = (2.0 * frustum.place(p) - middle * weight) / size;
    out.vertices.push_back({glm::vec4(glm::dvec4(clip, 0.0, weight)),
                            static_cast<float>((p.z - frustum.first) / frustum.thickness),
                            static_cast<float>(space.projection.weight(p))});
  };
  for (std::size_t i = 0; i < extents.size(); ++i) {
    const auto first = static_cast<std::uint32_t>(out.indices.size());
    auto vertex = static_cast<std::uint32_t>(out.vertices.size());
    extents[i].for_each_point(add);
    if (extents[i].whole)
      for (const IndexedTriangle& t : meshes[i]->triangles())
        for (const std::uint32_t v : t) out.indices.push_back(vertex + v);
    else
      for (; vertex < out.vertices.size(); ++vertex) out.indices.push_back(vertex);
    out.ranges.push_back({first, static_cast<std::uint32_t>(out.indices.size()) - first});
  }
  return out;
}

OcclusionMasks::OcclusionMasks(const gl::Functions& gl)
    : gl_(gl),
      program_(gl, {{GL_VERTEX_SHADER, "occlusion_mask.vert.glsl"},
                    {GL_FRAGMENT_SHADER, "occlusion_mask.frag.glsl"}}),
      vertices_(gl, Object::Kind::kBuffer),
      indices_(gl, Object::Kind::kBuffer),
      array_(gl, Object::Kind::kVertexArray),
      framebuffer_(gl, Object::Kind::kFramebuffer) {
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  const auto attribute = [&](GLuint index, GLint count, std::size_t at) {
    gl_.VertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, sizeof(MaskVertex),
                            reinterpret_cast<const void*>(at));
    gl_.EnableVertexAttribArray(index);
  };
  attribute(0, 4, offsetof(MaskVertex, clip));
  attribute(1, 1, offsetof(MaskVertex, slice));
  attribute(2, 1, offsetof(MaskVertex, in_front));
}

void OcclusionMasks::upload(const MaskGeometry& casters) const {
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(casters.vertices.size() * sizeof(MaskVertex)),
                 casters.vertices.data(), GL_STREAM_DRAW);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(casters.indices.size() * sizeof(std::uint32_t)),
                 casters.indices.data(), GL_STREAM_DRAW);
}

void OcclusionMasks::prepare_targets(int size, int count) {
  if (size != target_size_ || targets_.size() != static_cast<std::size_t>(count)) {
    targets_.clear();
    for (int i = 0; i < count; ++i) {
      targets_.push_back(std::make_unique<Object>(gl_, Object::Kind::kTexture));
      gl_.BindTexture(GL_TEXTURE_2D, *targets_.back());
      gl_.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, size, size);
    }
    target_size_ = size;
  }
  constexpr std::array<GLenum, 4> kAttachments{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                               GL_COLOR_ATTACHMENT2, GL_COLOR_ATTACHMENT3};
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  for (std::size_t i = 0; i < kAttachments.size(); ++i)
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, kAttachments[i], GL_TEXTURE_2D,
                             i < targets_.size() ? static_cast<GLuint>(*targets_[i]) : 0, 0);
  gl_.DrawBuffers(count, kAttachments.data());
  gl::require_complete_framebuffer(gl_, "drawing slices");
  constexpr float kNothing[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  for (int i = 0; i < count; ++i) gl_.ClearBufferfv(GL_COLOR, i, kNothing);
}

/// Channel c of target t is slice 4t + c.
std::vector<SliceTexels> OcclusionMasks::read_back(int targets, const OcclusionOptions& options) const {
  const auto texels =
      static_cast<std::size_t>(options.texture_size) * static_cast<std::size_t>(options.texture_size);
  const bool area = options.coverage == SliceCoverage::kArea;
  std::vector<std::uint8_t> rgba(4 * texels);
  std::vector<SliceTexels> slices(4 * static_cast<std::size_t>(targets));
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  for (std::size_t t = 0; t < static_cast<std::size_t>(targets); ++t) {
    gl_.ReadBuffer(static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + t));
    gl_.ReadPixels(0, 0, options.texture_size, options.texture_size, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    for (std::size_t c = 0; c < 4; ++c) {
      SliceTexels& slice = slices[4 * t + c];
      slice.resize(texels);
      std::uint8_t any = 0;
      for (std::size_t i = 0; i < texels; ++i) {
        slice[i] = coverage_of(rgba[4 * i + c], area);
        any |= slice[i];
      }
      if (!any) slice.clear();
    }
  }
  return slices;
}

void OcclusionMasks::draw_all(const MaskGeometry& casters, const std::vector<CasterDrawing>& drawings,
                              int samples) const {
  for (std::size_t i = 0; i < casters.ranges.size(); ++i) {
    const auto& [first_index, count] = casters.ranges[i];
    gl_.Uniform1i(program_.uniform("fills_next"), drawings[i].fills_next);
    if (drawings[i].front_only) gl_.Enable(GL_CULL_FACE);
    const auto* first =
        reinterpret_cast<const void*>(static_cast<std::uintptr_t>(first_index) * sizeof(std::uint32_t));
    gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT, first, samples);
    gl_.Disable(GL_CULL_FACE);
  }
}

std::vector<SliceTexels> OcclusionMasks::draw(const MaskGeometry& casters,
                                              const std::vector<CasterDrawing>& drawings,
                                              const OcclusionOptions& options, StageClock& clock) {
  const int targets = options.slices / 4;
  prepare_targets(options.texture_size, targets);
  gl_.Viewport(0, 0, options.texture_size, options.texture_size);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.CullFace(GL_FRONT);  // seen along right × up, which turns windings over
  gl_.Enable(GL_CLIP_DISTANCE0);
  gl_.Enable(GL_COLOR_LOGIC_OP);
  gl_.LogicOp(GL_OR);
  program_.use();
  const int samples = options.coverage == SliceCoverage::kArea ? kAreaSamples : 1;
  gl_.Uniform1f(program_.uniform("texels"), static_cast<float>(options.texture_size));
  gl_.Uniform1i(program_.uniform("samples"), samples);
  gl_.Uniform1i(program_.uniform("slice_count"), options.slices);
  upload(casters);
  draw_all(casters, drawings, samples);
  gl_.Disable(GL_COLOR_LOGIC_OP);
  gl_.Disable(GL_CLIP_DISTANCE0);
  gl_.Finish();
  clock.finish("slices");
  std::vector<SliceTexels> slices = read_back(targets, options);
  clock.finish("read_back");
  return slices;
}

}  // namespace penumbra::detail
