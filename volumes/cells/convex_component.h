// Whether a component is a convex solid, as far as rounded coordinates can be.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

/// True for a closed outward component that bends outward at every edge and winds once around its centroid.
/// An edge may bend inward by at most 1e-12 of the component's size: the corners of a rotated box are never
/// exactly coplanar. Winding once rules out star polyhedra. Penumbra volumes replace such a component by its
/// hull, so a wrong "true" makes them larger, never too small. Cost O(faces).
bool is_convex(const TriangleMesh& mesh, const Component& component);

}  // namespace penumbra::detail
