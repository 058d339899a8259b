// Silhouette method, step project: one edge as one receiver sees it, and whether it is near the disk.
//
// In: an edge, a receiver x. Out: the edge projected from x onto the plane of the disk,
//   p → x + (p - x) x.z / (x.z - p.z),
// with its jump, and whether it may meet the disk. This is the definition for one edge; lists of edges do the
// same in vectors (areas/projected_edges.h).
//
// What lies beyond x hides nothing from x. So an edge is cut just below the height of x: at an end p where
// x.z - p.z is 2^-23 of the horizontal distance between p and x. What is cut off projects 2^23 x.z away or
// farther, beyond any distance that matters, however near to x the edge passes. A vertex is cut off or kept
// for all its edges alike.
//
// An edge is near where it comes within 1 + slack of the disk's center and its jump is not 0. `slack` covers
// rounding. Let M be the largest coordinate, u = 2^-53, w = x.z - p.z. Coordinates are off by at most u M,
// which projection multiplies by x.z / w. The point of the segment that is nearest to the disk is computed
// from ends that are at most 2^24 M away, so it is off by less than 2^-53 2^24 M times a small number. The
// slack 1e-6 + 2^-26 M bounds both, where the end is 2^-24 M or more away from x; an edge that ends nearer to
// x, with a jump, is near whatever it projects to.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "render/silhouette/edges/band_edge.h"
#include "render/support/vector_clones.h"

namespace penumbra::detail {

/// Accuracy. The least x.z - p.z of what is projected, over the horizontal distance between p and x. Held by
/// the tests SilhouetteProperty.
inline constexpr double kLeastBelow = 0x1p-23;
/// Accuracy. Nearer ends make an edge near, over the largest coordinate.
inline constexpr double kTooClose = 0x1p-24;

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
  /// It may meet the disk.
  bool near;
};

/// Whether segment a b, whose ends are outside of the disk, comes within `reach` of the disk's center.
/// In: |a|², |b|², s² with s = b - a, a·s, a × s and reach². No division, since ends may be far away.
PENUMBRA_INLINE bool comes_near(double a2, double b2, double s2, double as, double cross, double reach2) {
  const bool before = as >= 0.0, beyond = -as >= s2;
  return ((before & (a2 < reach2)) | (beyond & (b2 < reach2)) |
          (!before & !beyond & (cross * cross < reach2 * s2)));
}

/// How far below x an end must lie to be projected; d: from x to the end.
PENUMBRA_INLINE double least_below(double dx, double dy) {
  return kLeastBelow * (std::abs(dx) + std::abs(dy));
}

/// The point of an edge p → q just below the height of x, where p lies too high; all relative to x, and w the
/// depths below x. Nothing where q lies too high as well, or the edge passes through x.
struct CutEnd {
  glm::dvec2 at;
  double w;
  bool exists;
};
inline CutEnd cut_below(const glm::dvec2& p, double wp, const glm::dvec2& q, double wq) {
  if (!(wq > wp)) return {p, wp, false};
  // Where the edge's line is at the height of x; there is nothing above x to be cut where p is below.
  const glm::dvec2 level = wp < 0.0 ? p - (wp / (wq - wp)) * (q - p) : p;
  const double w = least_below(level.x, level.y);
  if (!(w > 0.0) || !(wq > w)) return {p, wp, false};
  return {level + ((w - std::max(0.0, wp)) / (wq - wp)) * (q - p), w, true};
}

/// The segment from p to q, whatever the jump, which is left 0. An end that two edges share projects to the
/// same bits in both.
inline Projection project_segment(const Vec3& p, const Vec3& q, const Vec3& x, const Rounding& rounding) {
  // Cut it below the receiver.
  const glm::dvec2 from(x);
  glm::dvec2 a = glm::dvec2(p) - from, b = glm::dvec2(q) - from;
  double wa = x.z - p.z, wb = x.z - q.z;
  const bool a_below = wa > least_below(a.x, a.y), b_below = wb > least_below(b.x, b.y);
  if (!a_below && !b_below) return {{}, false};
  const bool close =
      std::min(glm::length(a) + std::abs(wa), glm::length(b) + std::abs(wb)) < kTooClose * rounding.extent;
  if (!a_below || !b_below) {
    const CutEnd cut = a_below ? cut_below(b, wb, a, wa) : cut_below(a, wa, b, wb);
    if (!cut.exists) return {{}, false};
    (a_below ? b : a) = cut.at;
    (a_below ? wb : wa) = cut.w;
  }

  // Project its ends.
  const glm::dvec2 pa = from + a * (x.z / wa), pb = from + b * (x.z / wb);

  // Compare it with the disk.
  if (close || glm::dot(pa, pa) < 1.0 || glm::dot(pb, pb) < 1.0) return {{pa, pb, 0}, true};
  const glm::dvec2 s = pb - pa;
  const double reach = 1.0 + rounding.slack;
  return {{pa, pb, 0},
          comes_near(glm::dot(pa, pa), glm::dot(pb, pb), glm::dot(s, s), glm::dot(pa, s),
                     pa.x * s.y - pa.y * s.x, reach * reach)};
}

/// Near only with a jump.
inline Projection project_edge(const BandEdge& e, const Vec3& x, const Rounding& rounding) {
  const int jump = jump_at(e, x, rounding.extent);
  if (jump == 0) return {{}, false};
  Projection out = project_segment(e.a, e.b, x, rounding);
  out.segment.jump = jump;
  return out;
}

}  // namespace penumbra::detail
