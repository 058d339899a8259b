// Joins faces of a solid into patches whose convex hulls the solid contains. A penumbra volume then needs one
// cell a patch instead of one a face.
//
// Let K be the hull of a patch of faces of a closed component whose winding number is nowhere negative. If no
// face of the component meets the interior of K, the winding number is constant there, and it is one more
// than beyond the patch's own faces: at least 1. Whatever K then hides from a point of the disk the surface
// hides too, since the winding number falls to 0 on the way out: the cell of K holds those of the patch's
// faces and nothing that the solid leaves lit.
//
// That no face meets the interior is proved by signs of orient3d alone:
//  - a face of the patch: no vertex of the patch is strictly beyond its plane, so it is part of a facet of K;
//  - another face whose box meets K's: no vertex of the patch is strictly beyond, and none of the face
//    strictly behind some plane through three of their vertices (of which K's own facets, the face, and edges
//    with a vertex of the other are tried).
// Degenerate faces bound nothing. A flat patch is the limit of hulls that reach a hair below it: a plane then
// also has to have a vertex of the patch strictly behind it, or be that of the patch's faces.
//
// Faces that meet others, and faces of inverted folds, are not to be joined (inverted_folds.h): K might reach
// out of the solid, and the volume be larger than it need be.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "volumes/cells/face_tree.h"

namespace penumbra::detail {

struct ConvexPatch {
  /// In the order in which they joined; connected across edges.
  std::vector<FaceId> faces;
  /// Each once.
  std::vector<std::uint32_t> vertices;
};

/// Finds the patches of a mesh's components one after another.
class PatchFinder {
 public:
  /// Keeps a reference to the mesh.
  explicit PatchFinder(const TriangleMesh& mesh);
  ~PatchFinder();

  /// Divides `members`, faces of a component of which none is degenerate, into patches as above. A face that
  /// can be joined to no other is a patch of its own. The component must be closed and oriented outward, and
  /// `component` holds its faces. Each
  /// patch grows breadth first to at most 64 faces. Where it begins and grows first depends on positions
  /// alone, so the order of faces changes nothing. Calls `after_each(patch)` for each patch; if that throws,
  /// the finder is of no further use. Expected cost O(n log n) for n faces of the component, times the number
  /// of faces near a patch.
  std::vector<ConvexPatch> find(const FaceTree& component, std::span<const FaceId> members,
                                const std::function<void(const ConvexPatch&)>& after_each = {});

 private:
  class Grower;
  std::unique_ptr<Grower> grower_;
};

}  // namespace penumbra::detail
