// Pipeline step 2: from face classes to silhouettes and the silhouette band.
//
// In: mesh and classes. Out: edge lists. "Umbra and penumbra volumes" (2004), section 2.1; the band is ours:
// every edge that can be a silhouette for some line between a receiver and the light.
//
// The line of an edge of the umbra or penumbra silhouette never meets the closed disk, since it lies in the
// plane of a strictly classified face. Around every vertex of a closed mesh either silhouette is balanced:
// with the face that looks at the light on the left, as many edges leave as arrive. Both are tested.
#pragma once

#include <vector>

#include "penumbra/volumes/classify.h"

namespace penumbra {

struct Silhouettes {
  std::vector<EdgeId> umbra;     ///< between a none-frontfacing face and one that is not
  std::vector<EdgeId> penumbra;  ///< between an all-frontfacing face and one that is not
  std::vector<EdgeId> band;      ///< faces not both all- nor both none-frontfacing
  // Boundary edges: those of a face that is not mixed belong to all three lists, those of a mixed face to the
  // band alone.
};

/// Whether an edge belongs to the band.
inline bool is_in_band(const Edge& edge, const Classification& classes) {
  const FaceClass left = classes.faces[index(edge.left)];
  return left == FaceClass::kMixed || edge.is_boundary() || left != classes.faces[index(edge.right)];
}

/// Lists in ascending edge order. Cost O(E).
Silhouettes find_silhouettes(const TriangleMesh& mesh, const Classification& classes);

}  // namespace penumbra
