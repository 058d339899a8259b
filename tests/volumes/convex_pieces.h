// Winding numbers of a sum of convex pieces. That a mesh is one is not taken on trust: pieces are what is
// connected in it, each is checked to be closed and convex, exactly. The winding number is then the number of
// pieces a point is in.
#pragma once

#include <map>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "tests/volumes/triangle_tree.h"
#include "volumes/predicates.h"

namespace penumbra::testing {

class ConvexPieces {
 public:
  ConvexPieces(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles)
      : positions_(positions), triangles_(triangles) {
    gather();
    // A tree over boxes, by way of one "triangle" per box.
    for (const Piece& piece : pieces_) {
      const auto first = static_cast<std::uint32_t>(box_corners_.size());
      box_corners_.insert(box_corners_.end(), {piece.box.low, piece.box.high, piece.box.high});
      box_triangles_.push_back({first, first + 1, first + 2});
    }
    tree_.emplace(box_corners_, box_triangles_);
  }

  std::size_t size() const { return pieces_.size(); }

  /// Every piece closed, outward and convex: no vertex beyond the plane of one of its triangles.
  bool all_convex_and_closed() const {
    for (const Piece& piece : pieces_) {
      std::set<std::pair<std::uint32_t, std::uint32_t>> half_edges;
      std::set<std::uint32_t> vertices;
      for (const std::uint32_t i : piece.triangles) {
        for (int k = 0; k < 3; ++k) {
          if (!half_edges.insert({triangles_[i][k], triangles_[i][(k + 1) % 3]}).second) return false;
          vertices.insert(triangles_[i][k]);
        }
      }
      for (const auto& [a, b] : half_edges) {
        if (!half_edges.count({b, a})) return false;
      }
      for (const std::uint32_t i : piece.triangles) {
        for (const std::uint32_t v : vertices) {
          if (is_beyond(positions_[v], i)) return false;
        }
      }
    }
    return true;
  }

  /// The winding number at x, or `enough` where it is at least that.
  int winding_number(const Vec3& x, int enough = std::numeric_limits<int>::max()) const {
    int winding = 0;
    tree_->find([&](const Bounds& box) { return is_in_box(x, box); },
                [&](std::uint32_t p) {
                  if (is_in_box(x, pieces_[p].box) && is_in_piece(x, pieces_[p])) ++winding;
                  return winding >= enough;
                });
    return winding;
  }

 private:
  struct Piece {
    std::vector<std::uint32_t> triangles;
    Bounds box;
  };

  static bool is_in_box(const Vec3& x, const Bounds& b) {
    return x.x >= b.low.x && x.y >= b.low.y && x.z >= b.low.z && x.x <= b.high.x && x.y <= b.high.y &&
           x.z <= b.high.z;
  }

  bool is_beyond(const Vec3& x, std::uint32_t i) const {
    const IndexedTriangle& t = triangles_[i];
    return orient3d(positions_[t[0]], positions_[t[1]], positions_[t[2]], x) == Sign::kPositive;
  }

  bool is_in_piece(const Vec3& x, const Piece& piece) const {
    return std::none_of(piece.triangles.begin(), piece.triangles.end(),
                        [&](std::uint32_t i) { return is_beyond(x, i); });
  }

  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

  void gather() {
    parent_.resize(positions_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (const IndexedTriangle& t : triangles_) {
      parent_[root(t[1])] = root(t[0]);
      parent_[root(t[2])] = root(t[0]);
    }
    std::map<std::uint32_t, std::size_t> number;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
      const auto [entry, added] = number.try_emplace(root(triangles_[i][0]), pieces_.size());
      if (added) pieces_.emplace_back();
      Piece& piece = pieces_[entry->second];
      piece.triangles.push_back(i);
      for (const std::uint32_t v : triangles_[i]) piece.box.add(positions_[v]);
    }
  }

  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  std::vector<std::uint32_t> parent_;
  std::vector<Piece> pieces_;
  std::vector<Vec3> box_corners_;
  std::vector<IndexedTriangle> box_triangles_;
  std::optional<TriangleTree> tree_;
};

}  // namespace penumbra::testing
