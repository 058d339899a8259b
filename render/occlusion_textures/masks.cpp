#include "render/occlusion_textures/masks.h"

#include <algorithm>
#include <array>
#include <bit>

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

OcclusionMasks::OcclusionMasks(const gl::Functions& gl, const std::vector<glm::vec3>& points,
                               const std::vector<std::uint32_t>& indices, std::vector<MaskRange> casters)
    : gl_(gl),
      program_(gl, {{GL_VERTEX_SHADER, "occlusion_mask.vert.glsl"},
                    {GL_FRAGMENT_SHADER, "occlusion_mask.frag.glsl"}}),
      points_(gl, Object::Kind::kBuffer),
      indices_(gl, Object::Kind::kBuffer),
      array_(gl, Object::Kind::kVertexArray),
      framebuffer_(gl, Object::Kind::kFramebuffer),
      casters_(std::move(casters)) {
  gl_.BindVertexArray(array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, points_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(points[0])), points.data(),
                 GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(indices[0])),
                 indices.data(), GL_STATIC_DRAW);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  gl_.EnableVertexAttribArray(0);
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

void OcclusionMasks::set_uniforms(const SliceFrustum& frustum, const glm::mat3& axes, const glm::vec3& offset,
                                  const OcclusionOptions& options) const {
  const auto at = [&](const char* name) { return program_.uniform(name); };
  const glm::vec2 middle(frustum.low + frustum.high), size(frustum.high - frustum.low);
  gl_.UniformMatrix3fv(at("light_axes"), 1, GL_FALSE, &axes[0][0]);
  gl_.Uniform3f(at("light_offset"), offset.x, offset.y, offset.z);
  gl_.Uniform1f(at("near_depth"), static_cast<float>(kNearSlice));
  gl_.Uniform1f(at("narrowing"), static_cast<float>(frustum.narrowing));
  gl_.Uniform2f(at("window_middle"), middle.x, middle.y);
  gl_.Uniform2f(at("window_size"), size.x, size.y);
  gl_.Uniform1f(at("texels"), static_cast<float>(options.texture_size));
  gl_.Uniform1i(at("samples"), options.coverage == SliceCoverage::kArea ? kAreaSamples : 1);
  gl_.Uniform1f(at("first_plane"), static_cast<float>(frustum.first));
  gl_.Uniform1f(at("thickness"), static_cast<float>(frustum.thickness));
  gl_.Uniform1i(at("slice_count"), frustum.count);
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

std::vector<SliceTexels> OcclusionMasks::draw(const SliceFrustum& frustum, const glm::mat3& axes,
                                              const glm::vec3& offset,
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
  set_uniforms(frustum, axes, offset, options);
  gl_.BindVertexArray(array_);
  const int samples = options.coverage == SliceCoverage::kArea ? kAreaSamples : 1;
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    gl_.Uniform1i(program_.uniform("fills_next"), drawings[i].fills_next);
    if (drawings[i].front_only) gl_.Enable(GL_CULL_FACE);
    const auto* first = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(casters_[i].first_index) *
                                                      sizeof(std::uint32_t));
    gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(casters_[i].index_count), GL_UNSIGNED_INT,
                              first, samples);
    gl_.Disable(GL_CULL_FACE);
  }
  gl_.Disable(GL_COLOR_LOGIC_OP);
  gl_.Disable(GL_CLIP_DISTANCE0);
  gl_.Finish();
  clock.finish("slices");
  std::vector<SliceTexels> slices = read_back(targets, options);
  clock.finish("read_back");
  return slices;
}

}  // namespace penumbra::detail
