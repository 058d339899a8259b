// Occlusion textures, step 1: from where the casters are seen, and into which slices they fall.
//
// In: casters, light, options. Out: a frustum with slices of equal thickness. "Occlusion textures" (2006),
// section 3.4 and figure 5. The center of projection lies d behind the light, and a point (x, y, z) of the
// light's frame is seen at q = (x, y) / (1 + z/d): where its line of sight meets the light's plane. The
// frustum through the light's border is then the light itself in q, for every d, and it contains a point when
// |q| ≤ half the light's extents, which gives the largest d that contains them all.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/light/area_light.h"
#include "render/occlusion_textures/occlusion_textures.h"

namespace penumbra::detail {

/// World → the light's frame with lengths times a power of two, so that the scene has about unit size.
struct SliceSpace {
  SliceSpace(const AreaLight& light_, double scale_)
      : light(light_), scale(scale_), half(light_.half * scale_) {}
  Vec3 to_light(const Vec3& world) const { return light.to_light(world) * scale; }
  AreaLight light;
  double scale;
  /// The light's half extents, in the light's frame.
  glm::dvec2 half;
};

/// Accuracy: casters are cut where they are nearer to the light's plane than this, in the light's frame.
/// Larger: more of them is lost.
inline constexpr double kNearSlice = 0x1p-13;
/// Accuracy: the widest tangent between a line of sight and the light's normal that an automatic offset
/// accepts. Wider frusta waste texels on what is far from the light's axis.
inline constexpr double kWidestSlope = 4.0;

struct DepthRange {
  double near = 1e300, far = -1e300;
  bool empty() const { return !(near <= far); }
  void add(double z);
  void add(const DepthRange& other);
};

/// What of a caster is in front of the light.
struct CasterExtent {
  /// Its vertices, and where its edges meet z = kNearSlice.
  std::vector<Vec3> points;
  DepthRange depth;
  /// A part of it is not in front.
  bool cut = false;
};
CasterExtent caster_extent(const TriangleMesh& mesh, const SliceSpace& space);

/// Slice i holds what lies between planes first + i·thickness (without) and first + (i+1)·thickness (with)
/// and is projected to the latter.
struct SliceFrustum {
  /// 1/d; 0: orthographic.
  double narrowing = 0.0;
  /// The window of the textures, in q.
  glm::dvec2 low{-1.0}, high{1.0};
  double first = 0.0, thickness = 1.0;
  int count = 4;
  double plane(int slice) const { return first + (slice + 1) * thickness; }
  glm::dvec2 project(const Vec3& p) const { return glm::dvec2(p) / (1.0 + narrowing * p.z); }
};

/// `casters` has at least one point; `depth` is the range to slice. The window gets a margin of two texels.
SliceFrustum fit_frustum(const std::vector<CasterExtent>& casters, const DepthRange& depth,
                         const SliceSpace& space, const OcclusionOptions& options);

/// 2·volume/area of a closed mesh, which is a plate's thickness; 0 of an open one. Scene units.
double mean_thickness(const TriangleMesh& mesh);

/// Whether lines of sight to the light's border move sideways, within one slice, by more than the object is
/// thick: light may then leak through it where it goes on in the next slice.
bool may_leak(double thickness, const CasterExtent& extent, const SliceSpace& space,
              const SliceFrustum& frustum);

}  // namespace penumbra::detail
