// Finer meshes of the same shape.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::testing {

/// Every face cut in four at the middles of its sides.
inline TriangleMesh cut_in_four(const TriangleMesh& mesh) {
  std::vector<Vec3> points(mesh.positions().begin(), mesh.positions().end());
  std::vector<IndexedTriangle> faces;
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto [at, is_new] =
        middles.try_emplace(std::uint64_t{high} << 32 | low, static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back(0.5 * (points[a] + points[b]));
    return at->second;
  };
  for (const IndexedTriangle& t : mesh.triangles()) {
    const std::uint32_t p = middle(t[0], t[1]), q = middle(t[1], t[2]), r = middle(t[2], t[0]);
    faces.push_back({t[0], p, r});
    faces.push_back({p, t[1], q});
    faces.push_back({r, q, t[2]});
    faces.push_back({p, q, r});
  }
  return TriangleMesh::build(points, faces);
}

}  // namespace penumbra::testing
