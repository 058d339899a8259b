// Which edges meet at each vertex. Nothing in it depends on the light, so one serves a mesh for good.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra {

class VertexRings {
 public:
  /// Cost O(V + E).
  explicit VertexRings(const TriangleMesh& mesh);
  /// The edges at v, ascending.
  std::span<const EdgeId> edges(VertexId v) const {
    return {edges_.data() + first_[index(v)], edges_.data() + first_[index(v) + 1]};
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<EdgeId> edges_;
};

}  // namespace penumbra
