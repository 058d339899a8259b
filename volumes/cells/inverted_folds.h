// Where a closed surface may cross itself inside out, so that it winds about points a negative number of
// times.
//
// Next to a face the winding number is one constant in front of it and one more behind it, wherever no other
// face meets it. It stays the same from a face to its neighbor across an edge that no third face meets. So
// faces that meet no others but along shared edges and at shared vertices form regions, each with one winding
// number in front, which a line from one of its faces to the outside tells.
#pragma once

#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "volumes/cells/face_tree.h"

namespace penumbra::detail {

/// The faces of a closed component that meet other faces, and those of regions that have, or may have, a
/// negative winding number of the component in front of them. In front of every other face it is 0 or more.
/// Ascending; none for a surface without self-intersections that is oriented outward. All signs are exact.
/// `tree` holds the component's faces. On all cores; expected cost O(n log n) for n faces.
std::vector<FaceId> faces_of_inverted_folds(const TriangleMesh& mesh, const Component& component,
                                            const FaceTree& tree);

}  // namespace penumbra::detail
