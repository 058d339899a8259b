// Solids: a grid of points, its division into tetrahedra, and which of its points are inside.
//
// Each cube of the grid is divided into the six tetrahedra around its diagonal from the lowest corner to the
// highest (H. Kuhn, 1960). So every edge leads from a vertex to one that is 0 or 1 further along each axis:
// an edge is its lower vertex and three bits. Vertices are numbered by blocks of 4×4×4, so that neighbors in
// number are neighbors in space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

using GridIndex = std::array<std::int32_t, 3>;

class SolidGrid {
 public:
  static constexpr int kBlock = 4;               ///< vertices a side
  static constexpr std::size_t kBlockSize = 64;  ///< vertices
  static constexpr std::uint32_t kNone = ~0u;

  /// Its corners are those of the box. Distances of vertices along each axis are at most `spacing`. Throws
  /// UsageError where that makes more than 2^31 vertices.
  SolidGrid(const Bounds& box, double spacing);

  const GridIndex& counts() const { return counts_; }  ///< vertices along each axis; multiples of kBlock
  const GridIndex& blocks() const { return blocks_; }
  std::size_t size() const { return inside_.size(); }
  std::size_t block_count() const { return inside_.size() / kBlockSize; }
  const Bounds& box() const { return box_; }
  const Vec3& step() const { return step_; }

  std::uint32_t vertex(const GridIndex& at) const {
    const auto block =
        static_cast<std::uint32_t>(((at[2] >> 2) * blocks_[1] + (at[1] >> 2)) * blocks_[0] + (at[0] >> 2));
    return block * 64 + static_cast<std::uint32_t>(((at[2] & 3) << 4) | ((at[1] & 3) << 2) | (at[0] & 3));
  }
  GridIndex place(std::uint32_t vertex) const {
    const auto block = static_cast<std::int32_t>(vertex >> 6), local = static_cast<std::int32_t>(vertex & 63);
    const std::int32_t row = block / blocks_[0];
    return {4 * (block % blocks_[0]) + (local & 3), 4 * (row % blocks_[1]) + (local >> 2 & 3),
            4 * (row / blocks_[1]) + (local >> 4)};
  }
  /// The vertex at the other end of an edge, or kNone beyond the grid.
  std::uint32_t beyond(std::uint32_t from, unsigned bits) const {
    GridIndex at = place(from);
    for (int k = 0; k < 3; ++k) {
      at[k] += static_cast<std::int32_t>(bits >> k & 1);
      if (at[k] >= counts_[k]) return kNone;
    }
    return vertex(at);
  }
  /// The lower vertex of an edge that ends here, or kNone.
  std::uint32_t before(std::uint32_t to, unsigned bits) const {
    GridIndex at = place(to);
    for (int k = 0; k < 3; ++k) {
      at[k] -= static_cast<std::int32_t>(bits >> k & 1);
      if (at[k] < 0) return kNone;
    }
    return vertex(at);
  }
  /// The same of blocks.
  std::uint32_t block_beyond(std::uint32_t block, unsigned bits) const {
    const auto b = static_cast<std::int32_t>(block);
    GridIndex at{b % blocks_[0], b / blocks_[0] % blocks_[1], b / blocks_[0] / blocks_[1]};
    for (int k = 0; k < 3; ++k) {
      at[k] += static_cast<std::int32_t>(bits >> k & 1);
      if (at[k] >= blocks_[k]) return kNone;
    }
    return static_cast<std::uint32_t>((at[2] * blocks_[1] + at[1]) * blocks_[0] + at[0]);
  }
  Vec3 point(const GridIndex& at) const;
  Vec3 point(std::uint32_t v) const { return point(place(v)); }
  /// The cube that holds a point of the box, by its lowest corner.
  GridIndex cube_of(const Vec3& p) const;

  bool is_inside(std::uint32_t vertex) const { return inside_[vertex] != 0; }
  void set_inside(std::uint32_t vertex, bool inside) { inside_[vertex] = inside ? 1 : 0; }

 private:
  Bounds box_;
  GridIndex counts_, blocks_;
  Vec3 step_;
  std::vector<char> inside_;
};

/// Calls visit(from, bits) for each of the edges at a vertex that the grid has, by the lower vertex.
template <class Visit>
void for_each_edge_at(const SolidGrid& grid, std::uint32_t vertex, const Visit& visit) {
  for (unsigned bits = 1; bits < 8; ++bits) {
    const std::uint32_t up = grid.beyond(vertex, bits), down = grid.before(vertex, bits);
    if (up != SolidGrid::kNone) visit(vertex, bits, up);
    if (down != SolidGrid::kNone) visit(down, bits, down);
  }
}

}  // namespace penumbra::detail
