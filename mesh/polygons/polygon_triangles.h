// Divides one polygon in space into triangles.
//
// In: the corners in order. Out: triangles whose sum has the polygon as its boundary, so that neighbors stay
// neighbors. The polygon may be concave, and holes may be joined to its outline by bridges.
//
// The polygon is looked at along an axis: the one that its area vector leans to most, then others that it
// leans to at least an eighth as much. In that projection, which rounds nothing:
//   1. A fan from the first corner is taken where its triangles do not overlap; so for all convex polygons.
//   2. Otherwise plane_triangulation.h divides it.
//   3. A polygon that crosses itself along each of these axes has no inside: it gets the fan.
// A polygon that is not planar is divided as its projection is. One without area gives triangles without
// area.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

struct PolygonTriangles {
  /// Numbers of corners, from 0.
  std::vector<IndexedTriangle> triangles;
  /// Some corner turns away from the others; certain.
  bool is_concave = false;
  /// Rule 3 was needed.
  bool crosses_itself = false;
};

/// Empty for fewer than three corners. Cost O(n) for convex polygons; else that of triangulate_line.
PolygonTriangles divide_polygon(std::span<const Vec3> corners);

}  // namespace penumbra::detail
