// A triangulation of the square [-4, 4]² in which points are inserted one after another (Lawson 1977), then
// segments between them by turning the sides that they cross (Sloan, "A fast algorithm for generating
// constrained Delaunay triangulations", 1993). All signs are exact.
//
// Our own, since CGAL's triangulations are under the GPL and penumbra::mesh is not.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/polygons/orientation.h"
#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Triangles run counter-clockwise. The square's corners are vertices 0 to 3; point i is vertex i + kFrame.
class SquareTriangulation {
 public:
  static constexpr std::uint32_t kFrame = 4, kNoTriangle = 0xFFFFFFFFu;

  /// The points are distinct and within [-1, 1]². Expected cost O(n log n).
  explicit SquareTriangulation(std::span<const Vec2> points);

  /// Makes sides of triangles of the segment from a to b, in pieces where it meets other points, which are
  /// returned in its order. Nothing where it crosses a segment inserted before.
  std::optional<std::vector<std::uint32_t>> insert_segment(std::uint32_t a, std::uint32_t b);

  std::size_t size() const { return triangles_.size(); }
  const IndexedTriangle& triangle(std::uint32_t t) const { return triangles_[t].v; }
  /// The triangle across the side that runs from corner k to the next.
  std::uint32_t across(std::uint32_t t, std::uint32_t k) const { return triangles_[t].n[(k + 2) % 3]; }
  std::uint32_t any_outside() const { return at_[0]; }

 private:
  using Side = std::pair<std::uint32_t, std::uint32_t>;  ///< two vertices
  struct Triangle {
    IndexedTriangle v;
    std::array<std::uint32_t, 3> n;  ///< across the side opposite to each corner
  };
  /// Corner k of triangle t.
  struct Corner {
    std::uint32_t t, k;
  };
  /// Triangles t = a b c and u = d c b beside it, and what lies across their outer sides: n of t, m of u.
  struct Quadrangle {
    std::uint32_t t, u;
    std::uint32_t a, b, c, d;
    std::uint32_t n_ca, n_ab, m_bd, m_dc;
  };

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orientation(points_[a], points_[b], points_[c]);
  }
  std::uint32_t corner_of(std::uint32_t t, std::uint32_t vertex) const {
    const IndexedTriangle& v = triangles_[t].v;
    return v[0] == vertex ? 0 : v[1] == vertex ? 1 : 2;
  }
  std::uint32_t back_from(std::uint32_t t, std::uint32_t neighbor) const {
    const auto& n = triangles_[t].n;
    return n[0] == neighbor ? 0 : n[1] == neighbor ? 1 : 2;
  }
  void set(std::uint32_t t, const IndexedTriangle& v, const std::array<std::uint32_t, 3>& n);
  void relink(std::uint32_t t, std::uint32_t from, std::uint32_t to);
  std::uint32_t locate(std::uint32_t p);
  void insert_point(std::uint32_t p);
  void split_triangle(std::uint32_t t, std::uint32_t p);
  /// Around the side opposite to corner a.
  Quadrangle quadrangle(Corner opposite) const;
  void split_side(Corner opposite, std::uint32_t p);
  void make_delaunay(std::uint32_t p);
  void flip(Corner opposite);
  bool lies_ahead(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  std::optional<std::uint32_t> advance(std::uint32_t a, std::uint32_t b);
  std::optional<std::uint32_t> collect_crossed(Corner at, std::uint32_t b, std::deque<Side>& crossed) const;
  bool turn_crossed(std::uint32_t a, std::uint32_t b, std::deque<Side>& crossed);
  Corner opposite_of(const Side& side) const;

  std::vector<Vec2> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> at_;  ///< for each vertex one of its triangles
  std::unordered_map<std::uint64_t, bool> fixed_;
  std::vector<Corner> doubtful_;
  std::uint32_t last_ = 0, random_ = 1;
};

/// Of a side, whichever way it runs.
inline std::uint64_t side_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

}  // namespace penumbra::detail
