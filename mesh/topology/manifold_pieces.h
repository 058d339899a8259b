// Turns any set of triangles into the faces of an oriented manifold with boundary, without losing one of
// them.
//
// In: positions and triangles as they come. Out: triangles over new vertices. Every edge has one face, or two
// that run along it in opposite directions. The faces at every vertex form one fan.
//
// The rule follows Guéziec et al., "Cutting and Stitching: Converting Sets of Polygons to Manifold Surfaces"
// (2001). It does not depend on the order of the faces:
//   1. An edge with exactly two faces, in opposite directions, connects them.
//   2. At an edge with more faces, those that may be parts of closed surfaces are joined in pairs by their
//      angle about it, where as many run one way as the other; then the others (mesh/topology/face_pairs.h).
//      What is left, and two faces in one direction, is cut.
//   3. A vertex gets one copy for each fan of faces that are connected around it.
//   4. Where both sides of a cut run between the same two copies, they are stitched again.
// Rule 4 is never ambiguous: an open fan has two ends, one that runs out of the vertex and one that runs into
// it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/topology/half_edges.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

struct ManifoldPieces {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  /// For each triangle its index in the input.
  std::vector<std::uint32_t> source_triangles;
  /// For each half-edge the one across it; kNoHalfEdge at a boundary.
  std::vector<std::uint32_t> opposite;
  /// All but the counts of what was flipped.
  BuildReport report;
};

/// `weld` merges vertices of exactly equal position first. Throws MeshError for an index out of range, a
/// coordinate that is not finite, or more faces than ids can name. Expected cost O(V + F log k), k faces at a
/// vertex.
ManifoldPieces cut_to_manifold(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                               bool weld);

}  // namespace penumbra::detail
