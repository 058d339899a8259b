// Silhouette method, step project: one edge as one receiver sees it, and whether it is near the disk.
//
// In: an edge, a receiver x. Out: the edge projected from x onto the plane of the disk,
//   p → x + (p - x) x.z / (x.z - p.z),
// with its jump, and whether it may meet the disk. This is the definition for one edge; lists of edges do the
// same in vectors (areas/projected_edges.h).
//
// What lies beyond x hides nothing from x. So an edge is cut just below the height of x, where x.z - p.z is
// 2^-23 x.z: what is cut off projects farther than any distance that matters.
//
// An edge is near where it comes within 1 + slack of the disk's center and its jump is not certainly 0.
// `slack` covers rounding. Let M be the largest coordinate, u = 2^-53, w = x.z - p.z. Coordinates are off
// by at most u M, which projection multiplies by x.z / w. The point of the segment that is nearest to the
// disk is computed from ends that are at most 2^24 M away, so it is off by less than 2^-53 2^24 M times a
// small number. The slack 1e-6 + 2^-26 M bounds both.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "render/silhouette/edges/band_edge.h"
#include "render/support/vector_clones.h"

namespace penumbra::detail {

/// Accuracy. The least x.z - p.z of what is projected, over x.z. Held by the tests SilhouetteProperty.
inline constexpr double kLeastBelow = 0x1p-23;

/// The margin of the certificate, in light radii at the disk. `extent`: the largest coordinate, M above.
inline double certificate_slack(double extent) {
  return 1e-6 + 0x1p-26 * extent;
}

/// A segment in the plane of the disk, seen from the light's front.
struct Segment {
  glm::dvec2 a, b;
  /// Faces on the left minus faces on the right of a → b.
  int jump;
};

struct Projection {
  Segment segment;
  /// It may meet the disk with a jump that is not 0.
  bool near;
};

/// Whether segment a b, whose ends are outside of the disk, comes within `reach` of the disk's center.
/// In: |a|², |b|², s² with s = b - a, a·s, a × s and reach². No division, since ends may be far away.
PENUMBRA_INLINE bool comes_near(double a2, double b2, double s2, double as, double cross, double reach2) {
  const bool before = as >= 0.0, beyond = -as >= s2;
  return ((before & (a2 < reach2)) | (beyond & (b2 < reach2)) |
          (!before & !beyond & (cross * cross < reach2 * s2)));
}

/// An end that two edges share projects to the same bits in both.
inline Projection project_edge(const BandEdge& e, const Vec3& x, double slack) {
  const double left = e.left.value(x), right = e.has_right() ? e.right.value(x) : 0.0;
  const int jump = (left > 0.0 ? 1 : -1) + (e.has_right() ? (right > 0.0 ? -1 : 1) : 0);
  const bool sure = std::abs(left) > e.left.tolerance && std::abs(right) > e.right.tolerance;
  if (jump == 0 && sure) return {{}, false};

  // Cut the edge below the receiver.
  const double least = kLeastBelow * x.z;
  double wa = x.z - e.a.z, wb = x.z - e.b.z;
  if (!(wa > least) && !(wb > least)) return {{}, false};
  glm::dvec2 a(e.a), b(e.b);
  const double wa0 = wa, wb0 = wb;
  if (!(wa > least)) a += ((least - wa0) / (wb0 - wa0)) * (glm::dvec2(e.b) - a), wa = least;
  if (!(wb > least)) b += ((least - wb0) / (wa0 - wb0)) * (glm::dvec2(e.a) - b), wb = least;

  // Project its ends.
  const glm::dvec2 from(x);
  const glm::dvec2 pa = from + (a - from) * (x.z / wa), pb = from + (b - from) * (x.z / wb);

  // Compare it with the disk.
  if (glm::dot(pa, pa) < 1.0 || glm::dot(pb, pb) < 1.0) return {{pa, pb, jump}, true};
  const glm::dvec2 s = pb - pa;
  const double reach = 1.0 + slack;
  return {{pa, pb, jump},
          comes_near(glm::dot(pa, pa), glm::dot(pb, pb), glm::dot(s, s), glm::dot(pa, s),
                     pa.x * s.y - pa.y * s.x, reach * reach)};
}

}  // namespace penumbra::detail
