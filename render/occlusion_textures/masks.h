// Occlusion textures, steps 2 and 3: all slices in one rendering pass, each texel of each slice covered or
// not.
//
// In: casters, frustum. Out: the texels of every slice. "Occlusion textures" (2006), section 3.4: a fragment
// shader turns depth into a color channel. Here fragments are joined by a bitwise OR instead of blending, so
// that a texel can also hold one bit for each of eight samples (area coverage) and drawing order does not
// matter.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "penumbra/mesh/stage_clock.h"
#include "render/gl/program.h"
#include "render/occlusion_textures/frustum.h"

namespace penumbra::detail {

/// Coverage 0 to 255 of one slice, row by row, row 0 at the window's low y. No texels: nothing is in it.
using SliceTexels = std::vector<std::uint8_t>;

/// A caster's corner as the center of projection sees it.
struct MaskVertex {
  /// Clip coordinates, but for the third.
  glm::vec4 clip;
  /// In slices from the first on, and the depth before the light, in any unit.
  float slice, in_front;
};

/// Casters to draw: three indices a face, one range of them a caster.
struct MaskGeometry {
  struct Range {
    std::uint32_t first_index, index_count;
  };
  std::vector<MaskVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Range> ranges;
};
/// One range an extent; `meshes` are theirs. Made in double and rounded at the end. Cost O(vertices + faces).
MaskGeometry mask_geometry(const std::vector<const TriangleMesh*>& meshes,
                           const std::vector<CasterExtent>& extents, const SliceSpace& space,
                           const SliceFrustum& frustum);

/// How one caster is drawn.
struct CasterDrawing {
  /// Into the next slice too.
  bool fills_next = false;
  /// Only faces towards the center of projection.
  bool front_only = false;
};

class OcclusionMasks {
 public:
  explicit OcclusionMasks(const gl::Functions& gl);

  /// `drawings`: one a caster. Adds the stages slices and read_back to the clock. Cost O(faces + texels ·
  /// slices).
  std::vector<SliceTexels> draw(const MaskGeometry& casters, const std::vector<CasterDrawing>& drawings,
                                const OcclusionOptions& options, StageClock& clock);

 private:
  void prepare_targets(int size, int count);
  void upload(const MaskGeometry& casters) const;
  void draw_all(const MaskGeometry& casters, const std::vector<CasterDrawing>& drawings, int samples) const;
  std::vector<SliceTexels> read_back(int targets, const OcclusionOptions& options) const;

  const gl::Functions& gl_;
  gl::Program program_;
  gl::Object vertices_, indices_, array_, framebuffer_;
  std::vector<std::unique_ptr<gl::Object>> targets_;
  int target_size_ = 0;
};

}  // namespace penumbra::detail
