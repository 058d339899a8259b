// Which closed components that face inward bound a cavity of a solid.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

/// For each component whether it faces inward (negative volume) and lies inside the others, which wind round
/// it at least once. Larger ones are asked first; those that are no cavity are taken as turned outward.
/// Whether a point is inside is told by solid angles at the middle of one face, in double. Cost O(faces) for
/// each component that faces inward and lies in the bounds of another.
std::vector<bool> find_cavities(std::span<const Component> components, std::span<const Vec3> positions,
                                std::span<const IndexedTriangle> triangles);

}  // namespace penumbra::detail
