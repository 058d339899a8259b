// Normals for smooth shading of meshes that have none.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Unit normals at the corners of each triangle: the mean, by area, over those triangles around the corner
/// that are turned against this one by less than the angle of the cosine, so that creases stay. Cost
/// O(triangles · triangles around a vertex).
std::vector<std::array<Vec3, 3>> corner_normals(std::span<const Vec3> positions,
                                                std::span<const IndexedTriangle> triangles,
                                                double least_cosine);

}  // namespace penumbra::detail
