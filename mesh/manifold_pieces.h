// Any set of triangles as the faces of an oriented manifold with boundary, without losing one of them.
//
// In: positions and triangles as they come. Out: triangles over new vertices such that every edge has one
// face, or two that run along it in opposite directions, and the faces at every vertex form one fan. The
// rule, after Guéziec et al., "Cutting and Stitching: Converting Sets of Polygons to Manifold Surfaces"
// (2001), does not depend on the faces' order:
//   1. an edge with exactly two faces in opposite directions connects them; any other edge is cut;
//   2. a vertex gets one copy for each fan of faces connected around it;
//   3. where a cut leaves both sides of an edge between the same two copies, they are stitched again. A
//   closed surface
//      that merely touches another along an edge, or carries a fin, so remains closed.
// Why 3 is never ambiguous: an open fan has two ends, one running out of the vertex and one into it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

inline constexpr std::uint32_t kNoHalfEdge = std::numeric_limits<std::uint32_t>::max();

/// Half-edge 3f+k runs from corner k to corner (k+1)%3 of triangle f.
struct ManifoldPieces {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  std::vector<std::uint32_t> source_triangles;  ///< per triangle its index in the input
  std::vector<std::uint32_t> opposite;  ///< per half-edge the one across it, kNoHalfEdge at a boundary
  BuildReport report;                   ///< all but the flips
};

/// Throws MeshError for an index out of range, a coordinate that is not finite, or more faces than ids can
/// name.
ManifoldPieces cut_to_manifold(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                               bool weld);

}  // namespace penumbra::detail
