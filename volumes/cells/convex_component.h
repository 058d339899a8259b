// Whether a component is a convex solid, as far as rounded coordinates can be.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

/// True for a closed outward component that bends outward at every edge (or inward by at most 1e-12 of its
/// size: the corners of a rotated box are never exactly coplanar) and winds once around its centroid, which
/// rules out star polyhedra. Penumbra volumes replace such a component by its hull, so a wrong "true" costs
/// tightness, never containment. Cost O(faces).
bool is_convex(const TriangleMesh& mesh, const Component& component);

}  // namespace penumbra::detail
