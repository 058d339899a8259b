#include "penumbra/mesh/vertex_rings.h"

namespace penumbra {

VertexRings::VertexRings(const TriangleMesh& mesh) {
  const auto edges = mesh.edges();
  first_.assign(mesh.positions().size() + 1, 0);
  for (const Edge& e : edges) {
    ++first_[index(e.from) + 1];
    ++first_[index(e.to) + 1];
  }
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  edges_.resize(2 * edges.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const EdgeId id{static_cast<std::uint32_t>(i)};
    edges_[next[index(edges[i].from)]++] = id;
    edges_[next[index(edges[i].to)]++] = id;
  }
}

}  // namespace penumbra
