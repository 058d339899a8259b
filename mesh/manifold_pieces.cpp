#include "mesh/manifold_pieces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <string>
#include <tuple>

#include "mesh/first_index.h"
#include "penumbra/mesh/error.h"

namespace penumbra::detail {
namespace {

constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
/// OpenMesh numbers half-edges with an int; six for each face is the most there can be.
constexpr std::size_t kMostFaces = std::numeric_limits<std::int32_t>::max() / 6;

std::uint32_t next_in_face(std::uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

void check_input(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles) {
  if (triangles.size() > kMostFaces || positions.size() >= kUnset) {
    throw MeshError("mesh: " + std::to_string(triangles.size()) + " faces are more than the " +
                    std::to_string(kMostFaces) + " that can be numbered; split it into several meshes");
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3& p = positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw MeshError("mesh: vertex " + std::to_string(i) +
                      " has a coordinate that is not finite; remove or repair that vertex");
    }
  }
  for (std::size_t f = 0; f < triangles.size(); ++f) {
    for (const std::uint32_t v : triangles[f]) {
      if (v >= positions.size()) {
        throw MeshError("mesh: triangle " + std::to_string(f) + " uses vertex " + std::to_string(v) +
                        ", but there are only " + std::to_string(positions.size()) + "; correct its indices");
      }
    }
  }
}

/// For each vertex the first one at exactly its position.
std::vector<std::uint32_t> weld_positions(std::span<const Vec3> positions) {
  std::vector<std::uint32_t> first(positions.size());
  FirstIndex table(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    const Vec3& p = positions[i];
    std::uint64_t hash = 0;
    for (const double x : {p.x, p.y, p.z}) {
      hash = mix(hash, std::bit_cast<std::uint64_t>(x + 0.0));  // -0 + 0 is +0
    }
    first[i] = table.find_or_insert(hash, i, [&](std::uint32_t j) { return positions[j] == p; });
  }
  return first;
}

/// Whether the cross product of two sides is exactly zero. A second look at a power of two of the size tells
/// collinear points from squares that underflow.
bool is_collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 zero(0.0);
  Vec3 u = b - a, v = c - a;
  if (glm::cross(u, v) != zero) {
    return false;
  }
  const auto scaled = [](const Vec3& w) {
    const double size = std::max({std::abs(w.x), std::abs(w.y), std::abs(w.z)});
    const int exponent = size > 0.0 ? -std::ilogb(size) : 0;
    return Vec3(std::ldexp(w.x, exponent), std::ldexp(w.y, exponent), std::ldexp(w.z, exponent));
  };
  return glm::cross(scaled(u), scaled(v)) == zero;
}

/// Fills triangles (with the vertices of `first`) and source_triangles, and reports what is odd about single
/// triangles. `place` identifies positions; it differs from `first` only where welding is off.
void keep_faces(std::span<const Vec3> positions, std::span<const IndexedTriangle> input,
                const std::vector<std::uint32_t>& place, bool weld, ManifoldPieces& pieces) {
  FirstIndex seen(input.size());
  const auto sorted_places = [&](std::uint32_t f) {
    IndexedTriangle t = {place[input[f][0]], place[input[f][1]], place[input[f][2]]};
    std::sort(t.begin(), t.end());
    return t;
  };
  for (std::uint32_t f = 0; f < input.size(); ++f) {
    const IndexedTriangle key = sorted_places(f);
    if (key[0] == key[1] || key[1] == key[2]) {
      pieces.report.degenerate.push_back(f);
      continue;
    }
    const auto& [a, b, c] = input[f];
    if (is_collinear(positions[a], positions[b], positions[c])) {
      pieces.report.zero_area.push_back(f);
    }
    const std::uint64_t hash = mix(mix(mix(0, key[0]), key[1]), key[2]);
    if (seen.find_or_insert(hash, f, [&](std::uint32_t g) { return sorted_places(g) == key; }) != f) {
      pieces.report.duplicates.push_back(f);
    }
    pieces.triangles.push_back(weld ? IndexedTriangle{place[a], place[b], place[c]} : input[f]);
    pieces.source_triangles.push_back(f);
  }
}

/// Half-edges grouped by their undirected edge: group i is half_edges[start[i] .. start[i+1]).
struct EdgeGroups {
  std::vector<std::uint32_t> half_edges, start;
};

/// Counting sort by the lower vertex, then each short bucket by the higher one.
EdgeGroups group_half_edges(const std::vector<IndexedTriangle>& triangles, std::size_t vertex_count) {
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

/// Rule 1. Returns the groups that were cut although they have more than one face.
std::vector<std::uint32_t> connect_faces(const EdgeGroups& groups, ManifoldPieces& pieces) {
  pieces.opposite.assign(3 * pieces.triangles.size(), kNoHalfEdge);
  const auto from = [&](std::uint32_t h) { return pieces.triangles[h / 3][h % 3]; };
  std::vector<std::uint32_t> cut;
  for (std::uint32_t g = 0; g + 1 < groups.start.size(); ++g) {
    const std::uint32_t size = groups.start[g + 1] - groups.start[g];
    const std::uint32_t* half_edges = groups.half_edges.data() + groups.start[g];
    if (size == 2 && from(half_edges[0]) != from(half_edges[1])) {
      pieces.opposite[half_edges[0]] = half_edges[1];
      pieces.opposite[half_edges[1]] = half_edges[0];
    } else if (size > 1) {
      ++(size == 2 ? pieces.report.misoriented_edges : pieces.report.non_manifold_edges);
      cut.push_back(g);
    }
  }
  return cut;
}

/// For each corner (numbered like the half-edge that leaves it) the lowest corner of its fan.
std::vector<std::uint32_t> find_fans(const std::vector<std::uint32_t>& opposite) {
  std::vector<std::uint32_t> parent(opposite.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t corner) {
    while (parent[corner] != corner) {
      corner = parent[corner] = parent[parent[corner]];
    }
    return corner;
  };
  const auto unite = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent[high] = low;
  };
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    if (opposite[h] != kNoHalfEdge && h < opposite[h]) {
      unite(h, next_in_face(opposite[h]));
      unite(next_in_face(h), opposite[h]);
    }
  }
  for (std::uint32_t corner = 0; corner < parent.size(); ++corner) {
    parent[corner] = root(corner);
  }
  return parent;
}

/// Rule 2. The first fan of each vertex keeps the vertices' order; further copies follow in the order of the
/// faces.
void copy_vertices(std::span<const Vec3> positions, const std::vector<std::uint32_t>& fans,
                   ManifoldPieces& pieces) {
  std::vector<std::uint32_t> first_fan(positions.size(), kUnset);
  std::vector<std::uint8_t> is_split(positions.size(), 0);
  std::vector<std::uint32_t> copies;  // lowest corners of further fans
  for (std::uint32_t corner = 0; corner < fans.size(); ++corner) {
    const std::uint32_t v = pieces.triangles[corner / 3][corner % 3];
    if (fans[corner] != corner) {
      continue;
    }
    if (first_fan[v] == kUnset) {
      first_fan[v] = corner;
    } else {
      copies.push_back(corner);
      pieces.report.non_manifold_vertices += is_split[v] == 0;
      is_split[v] = 1;
    }
  }
  std::vector<std::uint32_t> vertex_of_fan(fans.size(), kUnset);
  const auto add = [&](std::uint32_t fan, std::uint32_t v) {
    vertex_of_fan[fan] = static_cast<std::uint32_t>(pieces.positions.size());
    pieces.positions.push_back(positions[v]);
  };
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (first_fan[v] != kUnset) {
      add(first_fan[v], v);
    }
  }
  pieces.report.unused_vertices = positions.size() - pieces.report.welded_vertices - pieces.positions.size();
  pieces.report.split_vertices = copies.size();
  for (const std::uint32_t corner : copies) {
    add(corner, pieces.triangles[corner / 3][corner % 3]);
  }
  for (std::uint32_t corner = 0; corner < fans.size(); ++corner) {
    pieces.triangles[corner / 3][corner % 3] = vertex_of_fan[fans[corner]];
  }
}

/// Rule 3.
void stitch(const EdgeGroups& groups, const std::vector<std::uint32_t>& cut, ManifoldPieces& pieces) {
  struct Side {
    std::uint32_t low, high, half_edge;
  };
  std::vector<Side> sides;
  for (const std::uint32_t g : cut) {
    sides.clear();
    for (std::uint32_t i = groups.start[g]; i < groups.start[g + 1]; ++i) {
      const std::uint32_t h = groups.half_edges[i];
      const auto [low, high] =
          std::minmax(pieces.triangles[h / 3][h % 3], pieces.triangles[h / 3][next_in_face(h) % 3]);
      sides.push_back({low, high, h});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.half_edge) < std::tie(b.low, b.high, b.half_edge);
    });
    for (std::size_t i = 1; i < sides.size(); ++i) {
      if (sides[i].low == sides[i - 1].low && sides[i].high == sides[i - 1].high) {
        pieces.opposite[sides[i].half_edge] = sides[i - 1].half_edge;
        pieces.opposite[sides[i - 1].half_edge] = sides[i].half_edge;
      }
    }
  }
}

}  // namespace

ManifoldPieces cut_to_manifold(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                               bool weld) {
  check_input(positions, triangles);
  ManifoldPieces pieces;
  const std::vector<std::uint32_t> place = weld_positions(positions);
  for (std::uint32_t v = 0; weld && v < place.size(); ++v) {
    pieces.report.welded_vertices += place[v] != v;
  }
  keep_faces(positions, triangles, place, weld, pieces);
  const EdgeGroups groups = group_half_edges(pieces.triangles, positions.size());
  const std::vector<std::uint32_t> cut = connect_faces(groups, pieces);
  copy_vertices(positions, find_fans(pieces.opposite), pieces);
  stitch(groups, cut, pieces);
  return pieces;
}

}  // namespace penumbra::detail
