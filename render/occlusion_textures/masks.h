// Occlusion textures, steps 2 and 3: all slices in one rendering pass, each texel of each slice covered or
// not.
//
// In: casters, frustum. Out: the texels of every slice. "Occlusion textures" (2006), section 3.4: a fragment
// shader turns depth into a color channel. Here fragments are joined by a bitwise OR instead of blending, so
// that a texel can also hold one bit for each of eight samples (area coverage) and drawing order does not
// matter.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "penumbra/mesh/stage_clock.h"
#include "render/gl/program.h"
#include "render/occlusion_textures/frustum.h"

namespace penumbra::detail {

/// Coverage 0 to 255 of one slice, row by row, row 0 at the window's low y. No texels: nothing is in it.
using SliceTexels = std::vector<std::uint8_t>;

/// One caster in the uploaded buffers.
struct MaskRange {
  std::uint32_t first_index, index_count;
};

/// How one caster is drawn.
struct CasterDrawing {
  /// Into the next slice too.
  bool fills_next = false;
  /// Only faces towards the center of projection.
  bool front_only = false;
};

class OcclusionMasks {
 public:
  /// Uploads the casters' points, in the caster frame, and three indices a face.
  OcclusionMasks(const gl::Functions& gl, const std::vector<glm::vec3>& points,
                 const std::vector<std::uint32_t>& indices, std::vector<MaskRange> casters);

  /// The uploaded points are at axes · point + offset in the light's frame. `drawings`: one a caster. Adds
  /// the stages slices and read_back to the clock. Cost O(faces + texels · slices).
  std::vector<SliceTexels> draw(const SliceFrustum& frustum, const glm::mat3& axes, const glm::vec3& offset,
                                const std::vector<CasterDrawing>& drawings, const OcclusionOptions& options,
                                StageClock& clock);

 private:
  void prepare_targets(int size, int count);
  void set_uniforms(const SliceFrustum& frustum, const glm::mat3& axes, const glm::vec3& offset,
                    const OcclusionOptions& options) const;
  std::vector<SliceTexels> read_back(int targets, const OcclusionOptions& options) const;

  const gl::Functions& gl_;
  gl::Program program_;
  gl::Object points_, indices_, array_, framebuffer_;
  std::vector<std::unique_ptr<gl::Object>> targets_;
  int target_size_ = 0;
  std::vector<MaskRange> casters_;
};

}  // namespace penumbra::detail
