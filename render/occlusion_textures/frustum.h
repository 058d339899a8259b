// Occlusion textures, step 1: from where the casters are seen, and into which slices they fall.
//
// In: casters, receivers, light, options. Out: a frustum with slices of equal thickness. "Occlusion textures"
// (2006), section 3.4 and figure 5. The center of projection lies d behind the light, and a point (x, y, z)
// of the light's frame is seen at q = (x, y) / (1 + z/d): where its line of sight meets the light's plane.
// The frustum through the light's border is then the light itself in q, for every d, and it contains a point
// when |q| ≤ half the light's extents, which gives the largest d that contains them all.
//
// The light may be far away, or infinitely far. So all coordinates are relative to an origin near the
// receivers (render/light/light_projection.h), where the same view is ((x, y) + slide · z) / (1 + narrowing ·
// z), but for a factor. Only the part of the casters counts that may lie between a receiver and the light.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/light/light_projection.h"
#include "render/occlusion_textures/occlusion_textures.h"

namespace penumbra::detail {

/// The light, and local coordinates of its projection: (u, v, w), w away from the light.
struct SliceSpace {
  AreaLight light;
  LightProjection projection;
};

/// Accuracy: the widest tangent between a line of sight and the light's normal that an automatic offset
/// accepts. Wider frusta waste texels on what is far from the light's axis.
inline constexpr double kWidestSlope = 4.0;

/// Of w.
struct DepthRange {
  double near = 1e300, far = -1e300;
  bool empty() const { return !(near <= far); }
  void add(double w);
  void add(const DepthRange& other);
};

/// What receivers may see before the light: with (q, h) as of LightProjection, q between low - spread · (h -
/// bottom) and high + spread · (h - bottom), h above bottom.
struct SeenRegion {
  glm::dvec2 low{1e300}, high{-1e300};
  double bottom = 1e300;
  bool empty() const { return !(low.x <= high.x); }
};
/// `places`: local coordinates of receivers; those that are not numbers or not in front of the light do not
/// count.
SeenRegion region_of(std::span<const Vec3> places, const SliceSpace& space);

/// In local coordinates.
using LocalTriangle = std::array<Vec3, 3>;

/// What of a caster is in the region and in front of the light.
struct CasterExtent {
  /// Local coordinates of its vertices, all of them.
  std::vector<Vec3> vertices;
  /// All of it is in the region. Else `parts` is what there is of it in the region.
  bool whole = true;
  std::vector<LocalTriangle> parts;
  DepthRange depth;
  /// A part of it is not in front.
  bool cut = false;

  template <class Visit>
  void for_each_point(const Visit& visit) const {
    if (whole)
      for (const Vec3& p : vertices) visit(p);
    for (const LocalTriangle& part : parts)
      for (const Vec3& p : part) visit(p);
  }
};
/// Cost O(vertices), and O(faces) where not all of the caster is in the region.
CasterExtent caster_extent(const TriangleMesh& mesh, const SliceSpace& space, const SeenRegion& region);

/// Places q at which receivers of the region may have part of a caster before the light.
struct ShadowBounds {
  glm::dvec2 low{1e300}, high{-1e300};
  /// False for what is not in front of the light.
  bool contain(const Vec3& local, const LightProjection& light) const;
};
ShadowBounds shadow_bounds(const std::vector<CasterExtent>& casters, const SeenRegion& region,
                           const SliceSpace& space);

/// Slice i holds what lies between planes first + i·thickness (without) and first + (i+1)·thickness (with)
/// and is projected to the latter.
struct SliceFrustum {
  /// Of local coordinates. Both 0: orthographic.
  double narrowing = 0.0;
  glm::dvec2 slide{0.0};
  /// The window of the textures.
  glm::dvec2 low{-1.0}, high{1.0};
  double first = 0.0, thickness = 1.0;
  int count = 4;
  /// 1/d; 0: orthographic.
  double by_offset = 0.0;

  double plane(int slice) const { return first + (slice + 1) * thickness; }
  double weight(double w) const { return 1.0 + narrowing * w; }
  /// Not divided by the weight.
  glm::dvec2 place(const Vec3& p) const { return glm::dvec2(p) + slide * p.z; }
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
