// Solids: one closed surface around a region of shadow, from points that are judged by whoever calls.
//
//   shadow_box      where the region may be                      (shafts of boxes)
//   SolidGrid       a grid there; each point is judged           (the caller's judgment)
//   CrossedEdges    edges between inside and outside, bisected   (the caller's judgment)
//   carve           vertices moved along their edges until every triangle is on the safe side (shafts of
//                   triangles)
//   leave_out_bodies  where hollow solids are asked for
//   simplify        fewer triangles, moved to the safe side only
//
// Containment is a property of triangles. Let S be a closed surface and x a point inside that sees a point p
// of the light, which is outside. The segment x p crosses S at a point that sees p as well. So if all of S is
// in umbra, all inside is. Let S enclose the casters, and x be outside and not see a point p of the light.
// What hides p is inside, and the segment from x to it crosses S at a point that does not see p either. So if
// all of S is lit, S encloses the penumbra. In a convex bound the same holds of what is in it, and caps in
// the bound need no proof that they are lit.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/stage_clock.h"
#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"

namespace penumbra::detail {

/// The fraction of the light that each of some points sees, O. In the umbra it is 0, where all is seen 1,
/// else between. Neighbors in the list are neighbors in space.
using JudgePoints = std::function<std::vector<float>(std::span<const Vec3> points)>;

enum class ShadowRegion : std::uint8_t { kUmbra, kPenumbra, kLevel };

struct SolidMeshRequest {
  std::span<const TriangleMesh> casters;
  CircularLight light;
  ShadowRegion region = ShadowRegion::kPenumbra;
  /// Of kLevel: the region is where at most this fraction of the light is seen.
  double level = 0.5;
  /// Convex; the region ends there. It holds the casters.
  Bounds bound;
  /// Scene units: detail of this size is kept.
  double tolerance = 0.0;
  /// Bodies of casters do not belong to the region.
  bool hollow = false;
  JudgePoints judge;
  Progress progress{};
};

struct SolidMesh {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  /// One a triangle: it lies in the bound's boundary or in the light's plane.
  std::vector<char> is_cap;
  /// One a triangle: it is proved.
  std::vector<char> is_proved;
  /// Of the triangles that are not caps, those proved to be wholly in umbra, or wholly lit. All of them: the
  /// solid is proved.
  std::size_t proved = 0, to_prove = 0;
  std::size_t grid_points = 0, evaluations = 0, grid_triangles = 0;
  double spacing = 0.0;  ///< of grid points, scene units
  StageTimes stages;
};

/// The boundary of the region. Empty where there is none. Deterministic, on the calling arena's threads.
/// Throws UsageError where the grid would be too large, Cancelled.
SolidMesh mesh_shadow(const SolidMeshRequest& request);

}  // namespace penumbra::detail
