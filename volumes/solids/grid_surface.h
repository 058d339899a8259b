// Solids: the boundary of what is inside of a grid, by marching tetrahedra.
//
// A vertex of the surface lies on the open edge between a grid point inside and one outside, wherever that
// is. In each tetrahedron the surface is one triangle or two. At the grid's own boundary the surface is
// closed by caps in its planes. For any positions on the edges the result is a closed, oriented two-manifold
// without self-intersections.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "penumbra/mesh/types.h"
#include "volumes/solids/solid_grid.h"

namespace penumbra::detail {

/// An edge that the surface crosses.
struct CrossedEdge {
  std::uint32_t from;  ///< lower vertex
  std::uint8_t bits;   ///< to the upper one, see SolidGrid
  bool from_is_inside;
  /// It lies in the wall, and stays there.
  bool in_wall = false;
  /// It has moved since its triangles were looked at, and since they were last looked at from scratch.
  bool moved = true, doubtful = true;
  /// Of the edge, from its inner end on, in (0, 1).
  double at = 0.5;
  /// By which the next pull moves it.
  double pull = 0.0;
};

struct GridSurface {
  /// First one for each crossed edge, then grid points of caps.
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> cap_points;  ///< grid vertices, of the positions that follow the edges'
  std::vector<IndexedTriangle> triangles;
  /// One a triangle that lies inside of the grid: a vertex on which its shape depends as well as on its
  /// corners.
  std::vector<std::uint32_t> fourth;
  /// One a triangle, ascending. Triangles of two surfaces on one grid that have the same name have their
  /// corners on the same edges and grid points.
  std::vector<std::uint64_t> names;
  /// The first so many lie inside of the grid, the rest in caps.
  std::size_t inner_triangles = 0;
};

/// A plane behind which nothing is inside: normal · p > offset in front of it. Crossed edges that lead behind
/// it end there.
struct GridWall {
  Vec3 normal;
  double offset;
};

/// The crossed edges of a grid, ascending by lower vertex and bits.
class CrossedEdges {
 public:
  explicit CrossedEdges(const SolidGrid& grid, const std::optional<GridWall>& wall = std::nullopt)
      : grid_(grid), wall_(wall) {}

  /// Finds them anew; those that were crossed the same way before keep what is known of them. `start`: `at`
  /// and `pull` of others.
  void update(double at, double pull);
  std::vector<CrossedEdge>& all() { return edges_; }
  const std::vector<CrossedEdge>& all() const { return edges_; }
  /// The number of a crossed edge.
  std::uint32_t number(std::uint32_t from, unsigned bits) const;
  std::uint32_t inner_end(const CrossedEdge& e) const {
    return e.from_is_inside ? e.from : grid_.beyond(e.from, e.bits);
  }
  std::uint32_t outer_end(const CrossedEdge& e) const {
    return e.from_is_inside ? grid_.beyond(e.from, e.bits) : e.from;
  }
  Vec3 position(const CrossedEdge& e) const;
  const SolidGrid& grid() const { return grid_; }
  /// Blocks of vertices some of whose edges are crossed, or whose cubes hold crossed edges; ascending.
  const std::vector<std::uint32_t>& active_blocks() const { return active_; }

 private:
  void find_active_blocks();
  void put_into_wall(CrossedEdge& e) const;

  const SolidGrid& grid_;
  std::optional<GridWall> wall_;
  std::vector<std::uint32_t> active_;
  std::vector<std::uint32_t> first_;   ///< one a vertex
  std::vector<std::uint8_t> crossed_;  ///< one a vertex: bit b - 1 stands for the edge of bits b
  std::vector<CrossedEdge> edges_;
};

/// Where a tetrahedron has two triangles, they meet at the diagonal that makes the solid larger, or smaller.
enum class Diagonals : std::uint8_t { kLarger, kSmaller };

GridSurface grid_surface(const CrossedEdges& edges, Diagonals diagonals);

}  // namespace penumbra::detail
