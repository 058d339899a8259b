// Half-edges of a list of triangles: half-edge 3f+k runs from corner k to corner (k+1)%3 of triangle f. A
// corner has the number of the half-edge that leaves it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

inline constexpr std::uint32_t kNoHalfEdge = std::numeric_limits<std::uint32_t>::max();

inline std::uint32_t next_in_face(std::uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

inline std::uint32_t previous_in_face(std::uint32_t half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

/// The vertex at a corner; of a half-edge, where it begins.
inline std::uint32_t vertex_at(std::span<const IndexedTriangle> triangles, std::uint32_t corner) {
  return triangles[corner / 3][corner % 3];
}

/// Half-edges grouped by their undirected edge, edges in the order of their lower vertices, then of the
/// higher ones.
struct EdgeGroups {
  std::vector<std::uint32_t> half_edges, start;

  std::size_t size() const { return start.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return {half_edges.data() + start[group], half_edges.data() + start[group + 1]};
  }
};

/// Expected cost O(V + F log k), k faces at a vertex.
EdgeGroups group_half_edges(std::span<const IndexedTriangle> triangles, std::size_t vertex_count);

/// For each corner the lowest corner of its fan: of the faces that are joined round its vertex.
std::vector<std::uint32_t> find_fans(const std::vector<std::uint32_t>& opposite);

}  // namespace penumbra::detail
