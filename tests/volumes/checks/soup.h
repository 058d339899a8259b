// Triangles to be put together by hand.
#pragma once

#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::testing {

struct Soup {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;

  explicit Soup(const TriangleMesh& mesh)
      : positions(mesh.positions().begin(), mesh.positions().end()),
        triangles(mesh.triangles().begin(), mesh.triangles().end()) {}
  void add(const Soup& other) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    for (const IndexedTriangle& t : other.triangles)
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  void turn_round() {
    for (IndexedTriangle& t : triangles) std::swap(t[1], t[2]);
  }
};

}  // namespace penumbra::testing
