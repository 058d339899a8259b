// One convex cell of a penumbra volume: all points from which a convex body hides some of the light.
//
// Let K be convex, in front of the light's plane, and P a convex polygon in that plane around the disk. A
// point x is shaded by k ∈ K from p ∈ P iff x = p + s(k - p) for an s ≥ 1. The set C of all such x is K ⊕
// cone(K - P):
//   p + s(k - p) = k + (s - 1)(k - p); and, the other way round, k' + t(k - p) = (1 + t)k" - tp with
//   k" = (k' + tk)/(1 + t) ∈ K, hence x = p + s(k" - p), s = 1 + t.
// So C is convex. Its vertices are vertices k of K, its unbounded edges start there along k - p, p a corner
// of P. Cut off at a plane beyond K that is parallel to the light, it is the convex hull of K and the points
// in which those edges meet the plane. Cut off at s ≤ S it is conv(K ∪ {Sk + (1 - S)p}).
//
// For a distant light P is a set of directions and C is K ⊕ cone(-P), cut off by a plane. All points are
// found from k on, never from p: what is rounded is in proportion to the cell, not to the light's distance.
#pragma once

#include <span>
#include <vector>

#include "volumes/cells/shadow_reach.h"

namespace penumbra::detail {

struct Cell {
  std::vector<Vec3> positions;
  /// Closed, oriented outward. None where the cell has no interior.
  std::vector<IndexedTriangle> triangles;
  /// One per triangle: kCell or kFarCap.
  std::vector<ShadowKind> kinds;
};

/// Corners of a regular polygon circumscribed to the unit circle.
struct UnitPolygon {
  explicit UnitPolygon(int corners);
  std::vector<std::array<double, 2>> corners;
  double circumradius;
};

/// Whether the cell of conv(body) ends at a plane parallel to the light; always with a distant light. Bodies
/// that come too near to the light's plane for that end at a distance, the larger the body the more loosely.
bool is_cut_by_depth(std::span<const Vec3> body, const ShadowReach& reach);

/// The cell of conv(body). The body is in front of the light's plane, or behind it by rounding at most.
/// Within the bound the cell contains every point that conv(body) shades from some point of the disk. A light
/// of radius 0 is a point.
Cell make_penumbra_cell(std::span<const Vec3> body, const ShadowReach& reach, const UnitPolygon& polygon);

}  // namespace penumbra::detail
