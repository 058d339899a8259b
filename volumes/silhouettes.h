// Silhouettes: from face classes to the edges that bound shadows.
//
// In: a mesh and the classes of its faces. Out: lists of edges. "Umbra and penumbra volumes" (2004), section
// 2.1. The band is ours: every edge that can be a silhouette for some line between a receiver and the light.
//
// The line of an edge of the umbra or penumbra silhouette never meets the closed disk, since it lies in the
// plane of a strictly classified face. At every vertex of a closed mesh either silhouette is balanced: with
// the face that looks at the light on the left, as many of its edges leave the vertex as arrive.
#pragma once

#include <vector>

#include "penumbra/volumes/classify.h"

namespace penumbra {

/// Edges in ascending order. A boundary edge of a mixed face belongs to the band alone. A boundary edge of
/// any other face belongs to all three lists.
struct Silhouettes {
  /// Between a none-frontfacing face and one that is not.
  std::vector<EdgeId> umbra;
  /// Between an all-frontfacing face and one that is not.
  std::vector<EdgeId> penumbra;
  /// Between two faces that are not both all-frontfacing, nor both none-frontfacing.
  std::vector<EdgeId> band;
};

/// Whether an edge belongs to the band.
inline bool is_in_band(const Edge& edge, const Classification& classes) {
  const FaceClass left = classes.faces[index(edge.left)];
  return left == FaceClass::kMixed || edge.is_boundary() || left != classes.faces[index(edge.right)];
}

/// `classes` are those of this mesh. Cost O(E).
Silhouettes find_silhouettes(const TriangleMesh& mesh, const Classification& classes);

}  // namespace penumbra
