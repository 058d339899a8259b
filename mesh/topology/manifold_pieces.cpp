#include "mesh/topology/manifold_pieces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <tuple>

#include "mesh/topology/face_pairs.h"
#include "mesh/topology/first_index.h"
#include "penumbra/mesh/error.h"

namespace penumbra::detail {
namespace {

constexpr std::uint32_t kUnset = std::numeric_limits<std::uint32_t>::max();
/// OpenMesh numbers half-edges with an int; six for each face is the most there can be.
constexpr std::size_t kMostFaces = std::numeric_limits<std::int32_t>::max() / 6;

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

/// Rule 1. Returns the other groups of more than one face.
std::vector<std::uint32_t> connect_faces(const EdgeGroups& groups, ManifoldPieces& pieces) {
  pieces.opposite.assign(3 * pieces.triangles.size(), kNoHalfEdge);
  const auto from = [&](std::uint32_t h) { return pieces.triangles[h / 3][h % 3]; };
  std::vector<std::uint32_t> crowded;
  for (std::uint32_t g = 0; g + 1 < groups.start.size(); ++g) {
    const std::uint32_t size = groups.start[g + 1] - groups.start[g];
    const std::uint32_t* half_edges = groups.half_edges.data() + groups.start[g];
    if (size == 2 && from(half_edges[0]) != from(half_edges[1])) {
      pieces.opposite[half_edges[0]] = half_edges[1];
      pieces.opposite[half_edges[1]] = half_edges[0];
    } else if (size > 1) {
      ++(size == 2 ? pieces.report.misoriented_edges : pieces.report.non_manifold_edges);
      crowded.push_back(g);
    }
  }
  return crowded;
}

/// Rule 3. The first fan of each vertex keeps the vertices' order; further copies follow in the order of the
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

/// Rule 4.
void stitch(const EdgeGroups& groups, const std::vector<std::uint32_t>& crowded, ManifoldPieces& pieces) {
  struct Side {
    std::uint32_t low, high, half_edge;
  };
  std::vector<Side> sides;
  for (const std::uint32_t g : crowded) {
    sides.clear();
    for (const std::uint32_t h : groups[g]) {
      if (pieces.opposite[h] != kNoHalfEdge) continue;
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
    const bool joined =
        std::ranges::none_of(groups[g], [&](std::uint32_t h) { return pieces.opposite[h] == kNoHalfEdge; });
    pieces.report.joined_edges += joined && groups[g].size() > 2;
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
  const std::vector<std::uint32_t> crowded = connect_faces(groups, pieces);
  pair_faces(positions, pieces.triangles, groups, crowded, pieces.opposite);
  copy_vertices(positions, find_fans(pieces.opposite), pieces);
  stitch(groups, crowded, pieces);
  return pieces;
}

}  // namespace penumbra::detail
