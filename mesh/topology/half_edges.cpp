#include "mesh/topology/half_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh/topology/disjoint_sets.h"

namespace penumbra::detail {

/// Counting sort by the lower vertex, then each short bucket by the higher one.
EdgeGroups group_half_edges(std::span<const IndexedTriangle> triangles, std::size_t vertex_count) {
  struct Entry {
    std::uint32_t high, half_edge;
  };
  std::vector<std::uint32_t> bucket(vertex_count + 1, 0);
  std::vector<Entry> entries(3 * triangles.size());
  const auto ends = [&](std::uint32_t h) {
    return std::minmax(triangles[h / 3][h % 3], triangles[h / 3][next_in_face(h) % 3]);
  };
  for (std::uint32_t h = 0; h < entries.size(); ++h) {
    ++bucket[ends(h).first + 1];
  }
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<std::uint32_t> fill(bucket.begin(), bucket.end() - 1);
  for (std::uint32_t h = 0; h < entries.size(); ++h) {
    entries[fill[ends(h).first]++] = {ends(h).second, h};
  }
  EdgeGroups groups;
  groups.half_edges.reserve(entries.size());
  groups.start.reserve(entries.size() / 2 + 1);
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const auto begin = entries.begin() + bucket[v], end = entries.begin() + bucket[v + 1];
    std::sort(begin, end, [](const Entry& a, const Entry& b) {
      return std::tie(a.high, a.half_edge) < std::tie(b.high, b.half_edge);
    });
    for (auto it = begin; it != end; ++it) {
      if (it == begin || it->high != (it - 1)->high) {
        groups.start.push_back(static_cast<std::uint32_t>(groups.half_edges.size()));
      }
      groups.half_edges.push_back(it->half_edge);
    }
  }
  groups.start.push_back(static_cast<std::uint32_t>(groups.half_edges.size()));
  return groups;
}

std::vector<std::uint32_t> find_fans(const std::vector<std::uint32_t>& opposite) {
  DisjointSets fans(opposite.size());
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    if (opposite[h] != kNoHalfEdge && h < opposite[h]) {
      fans.join(h, next_in_face(opposite[h]));
      fans.join(next_in_face(h), opposite[h]);
    }
  }
  return std::move(fans).all();
}

}  // namespace penumbra::detail
