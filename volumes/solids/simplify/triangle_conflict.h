// Solids: whether two triangles of a surface meet where they should not.
#pragma once

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Have the triangles more in common than the corners that they share by index? Exact but for two triangles
/// in one plane, which are compared in double. Where they touch they are taken to meet. Cost O(1).
bool are_in_conflict(const std::array<Vec3, 3>& p, const IndexedTriangle& a, const std::array<Vec3, 3>& q,
                     const IndexedTriangle& b);

}  // namespace penumbra::detail
