// Winding numbers of a sum of convex pieces. That a mesh is one is not taken on trust: pieces are what is
// connected in it, each is checked to be closed and convex, exactly. The winding number is then the number of
// pieces a point is in.
#pragma once

#include <map>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "penumbra/volumes/predicates/predicates.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra::testing {

class ConvexPieces {
 public:
  ConvexPieces(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
               const CircularLight& light)
      : positions_(positions), triangles_(triangles), light_(light), frame_(light_frame(light)) {
    compute_planes();
    collect();
    witness_.assign(pieces_.size(), 0);
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

  /// The winding number at x, in front of the light, or `enough` where it is at least that.
  int winding_number(const Vec3& x, int enough = std::numeric_limits<int>::max()) {
    const Vec3 image = project(x);
    int winding = 0;
    tree_->find([&](const Bounds& box) { return is_in_box(image, box); },
                [&](std::uint32_t p) {
                  if (is_in_box(image, pieces_[p].box) && is_in_piece(x, p)) ++winding;
                  return winding >= enough;
                });
    return winding;
  }

  /// The greatest t in [0, 1] at which x + t·way is in some piece, in rounded arithmetic; below 0 where it is
  /// in none.
  double last_exit(const Vec3& x, const Vec3& way) const {
    const Vec3 from = project(x), to = project(x + way);
    double last = -1.0;
    tree_->find([&](const Bounds& box) { return segment_meets_box(from, to - from, box); },
                [&](std::uint32_t p) {
                  last = std::max(last, exit_of(x, way, pieces_[p], last));
                  return false;
                });
    return last;
  }

 private:
  struct Piece {
    std::vector<std::uint32_t> triangles;
    Bounds box;
  };
  struct Plane {
    Vec3 normal;
    double offset, size, reach;
  };

  static bool is_in_box(const Vec3& x, const Bounds& b) {
    return x.x >= b.low.x && x.y >= b.low.y && x.z >= b.low.z && x.x <= b.high.x && x.y <= b.high.y &&
           x.z <= b.high.z;
  }

  /// Exact; a rounded plane with a generous margin decides nearly always.
  bool is_beyond(const Vec3& x, std::uint32_t i) const {
    constexpr double kMargin = 1e-11;
    const Plane& plane = planes_[i];
    const double height = glm::dot(plane.normal, x) - plane.offset;
    const double margin =
        kMargin * plane.size * (std::abs(x.x) + std::abs(x.y) + std::abs(x.z) + plane.reach);
    if (std::abs(height) > margin) return height > 0.0;
    const IndexedTriangle& t = triangles_[i];
    return orient3d(positions_[t[0]], positions_[t[1]], positions_[t[2]], x) == Sign::kPositive;
  }

  void compute_planes() {
    for (const IndexedTriangle& t : triangles_) {
      const Vec3 &p = positions_[t[0]], &q = positions_[t[1]], &r = positions_[t[2]];
      const Vec3 normal = glm::cross(q - p, r - p);
      // The normal's error is relative to the product of the sides, not to its own length.
      const double size = glm::length(q - p) * glm::length(r - p);
      const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      planes_.push_back({normal, glm::dot(normal, p), size, 3.0 * reach});
    }
  }

  /// Tries first the triangle that kept the previous point out.
  bool is_in_piece(const Vec3& x, std::uint32_t p) {
    const std::vector<std::uint32_t>& triangles = pieces_[p].triangles;
    if (is_beyond(x, triangles[witness_[p]])) return false;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (!is_beyond(x, triangles[i])) continue;
      witness_[p] = i;
      return false;
    }
    return true;
  }

  double exit_of(const Vec3& x, const Vec3& way, const Piece& piece, double at_least) const {
    double enter = 0.0, leave = 1.0;
    for (const std::uint32_t i : piece.triangles) {
      const double height = glm::dot(planes_[i].normal, x) - planes_[i].offset;
      const double slope = glm::dot(planes_[i].normal, way);
      if (slope > 0.0) {
        leave = std::min(leave, -height / slope);
      } else if (slope < 0.0) {
        enter = std::max(enter, -height / slope);
      } else if (height > 0.0) {
        return -1.0;
      }
      if (leave < enter || leave <= at_least) return -1.0;
    }
    return leave;
  }

  /// Rays of the light's center become parallel to the third axis; those of a distant light are.
  Vec3 project(const Vec3& x) const {
    if (light_.is_distant()) return {glm::dot(x, frame_.u), glm::dot(x, frame_.v), glm::dot(x, frame_.w)};
    const Vec3 d = x - light_.center;
    const double depth = glm::dot(d, frame_.w);
    return {glm::dot(d, frame_.u) / depth, glm::dot(d, frame_.v) / depth, -1.0 / depth};
  }

  /// The box of a piece's image, a little wider than computed; everything where the piece is not well in
  /// front.
  Bounds box_of(const std::vector<std::uint32_t>& triangles) const {
    constexpr double kSlack = 1e-9, kEverything = 1e300;
    Bounds box;
    for (const std::uint32_t i : triangles) {
      for (const std::uint32_t v : triangles_[i]) {
        const double depth = glm::dot(positions_[v] - light_.center, frame_.w);
        if (!light_.is_distant() && depth < 1e-6) return {Vec3(-kEverything), Vec3(kEverything)};
        box.add(project(positions_[v]));
      }
    }
    for (int k = 0; k < 3; ++k) {
      const double slack = kSlack * (1.0 + std::abs(box.low[k]) + std::abs(box.high[k]));
      box.low[k] -= slack;
      box.high[k] += slack;
    }
    return box;
  }

  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

  void collect() {
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
      pieces_[entry->second].triangles.push_back(i);
    }
    for (Piece& piece : pieces_) piece.box = box_of(piece.triangles);
  }

  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  CircularLight light_;
  LightFrame frame_;
  std::vector<std::uint32_t> parent_, witness_;
  std::vector<Plane> planes_;
  std::vector<Piece> pieces_;
  std::vector<Vec3> box_corners_;
  std::vector<IndexedTriangle> box_triangles_;
  std::optional<TriangleTree> tree_;
};

}  // namespace penumbra::testing
