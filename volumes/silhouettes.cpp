#include "penumbra/volumes/silhouettes.h"

namespace penumbra {

Silhouettes find_silhouettes(const TriangleMesh& mesh, const Classification& classes) {
  Silhouettes result;
  for (std::size_t i = 0; i < mesh.edges().size(); ++i) {
    const Edge& edge = mesh.edges()[i];
    const EdgeId id{static_cast<std::uint32_t>(i)};
    const FaceClass left = classes.faces[index(edge.left)];
    if (is_in_band(edge, classes)) result.band.push_back(id);
    if (edge.is_boundary()) {
      // Beyond a boundary there is no face: neither one that looks at the light nor one that looks away.
      if (left != FaceClass::kMixed) {
        result.umbra.push_back(id);
        result.penumbra.push_back(id);
      }
      continue;
    }
    const FaceClass right = classes.faces[index(edge.right)];
    if ((left == FaceClass::kNoneFront) != (right == FaceClass::kNoneFront)) result.umbra.push_back(id);
    if ((left == FaceClass::kAllFront) != (right == FaceClass::kAllFront)) result.penumbra.push_back(id);
  }
  return result;
}

}  // namespace penumbra
