// Solids: a surface while edges collapse.
#pragma once

#include <cstdint>
#include <vector>

#include "volumes/solids/simplify/one_sided_point.h"
#include "volumes/solids/simplify/simplify.h"

namespace penumbra::detail {

/// Collapses in different places may change it at the same time: each touches only what belongs to the
/// vertices and triangles around its edge.
struct ChangingSurface {
  static constexpr std::uint32_t kGone = ~0u;

  ChangingSurface(IndexedSurface surface, const SimplifyOptions& options);

  std::array<Vec3, 3> corners(const IndexedTriangle& t) const {
    return {positions[t[0]], positions[t[1]], positions[t[2]]};
  }
  /// Bits of the sides of the box that a triangle lies in.
  std::uint8_t side_of(const IndexedTriangle& t) const {
    return on_side[t[0]] & on_side[t[1]] & on_side[t[2]];
  }
  bool is_edge(std::uint32_t a, std::uint32_t b) const;
  /// Puts `a` to a point; `b` becomes a part of it, and the two triangles at the edge are gone.
  void collapse(std::uint32_t a, std::uint32_t b, const Vec3& point, double error);
  /// What is left, without gaps.
  IndexedSurface result() const;

  const SimplifyOptions& options;
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;  ///< kGone: no more
  std::vector<std::vector<std::uint32_t>> faces_at;
  std::vector<Quadric> quadrics;      ///< about the origin below
  std::vector<double> errors;         ///< how far the surface at a vertex may have moved
  std::vector<std::uint8_t> on_side;  ///< bits of the box's sides: three low ones, three high ones
  std::vector<std::uint32_t> version;
  std::vector<std::uint32_t> became;  ///< the vertex that a vertex was joined to, or itself
  Vec3 origin{0.0};
  double rounding = 0.0;
};

inline bool has(const IndexedTriangle& t, std::uint32_t v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

}  // namespace penumbra::detail
