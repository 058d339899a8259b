// A bounding-box tree over triangles, for oracles, and the winding number of a closed mesh by counting
// crossings.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/predicates/predicates.h"
#include "tests/volumes/random_inputs.h"

namespace penumbra::testing {

class TriangleTree {
 public:
  TriangleTree(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles)
      : positions_(positions), triangles_(triangles), order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, order_.size());
  }

  /// Calls visit(triangle index) for triangles in boxes that `overlaps`; stops when visit returns true, and
  /// says so.
  template <class Overlaps, class Visit>
  bool find(Overlaps overlaps, Visit visit) const {
    return !nodes_.empty() && find_in(0, overlaps, visit);
  }

  std::span<const Vec3> positions() const { return positions_; }
  const IndexedTriangle& triangle(std::uint32_t i) const { return triangles_[i]; }
  const Vec3& corner(std::uint32_t i, int k) const { return positions_[triangles_[i][k]]; }

 private:
  struct Node {
    Bounds box;
    std::size_t begin, end;  // of order_, for leaves
    std::size_t right = 0;   // the left child follows its parent; 0: a leaf
  };

  std::size_t build(std::size_t begin, std::size_t end) {
    constexpr std::size_t kLeaf = 4;
    const std::size_t self = nodes_.size();
    nodes_.push_back({{}, begin, end});
    Bounds centers;
    for (std::size_t i = begin; i < end; ++i) {
      for (int k = 0; k < 3; ++k) nodes_[self].box.add(corner(order_[i], k));
      centers.add(center(order_[i]));
    }
    if (end - begin <= kLeaf) return self;
    const Vec3 size = centers.high - centers.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::size_t middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return center(a)[axis] < center(b)[axis]; });
    build(begin, middle);
    const std::size_t right = build(middle, end);
    nodes_[self].right = right;
    return self;
  }

  Vec3 center(std::uint32_t i) const { return (corner(i, 0) + corner(i, 1) + corner(i, 2)) / 3.0; }

  template <class Overlaps, class Visit>
  bool find_in(std::size_t n, Overlaps& overlaps, Visit& visit) const {
    const Node& node = nodes_[n];
    if (!overlaps(node.box)) return false;
    if (node.right != 0) return find_in(n + 1, overlaps, visit) || find_in(node.right, overlaps, visit);
    for (std::size_t i = node.begin; i < node.end; ++i) {
      if (visit(order_[i])) return true;
    }
    return false;
  }

  std::span<const Vec3> positions_;
  std::span<const IndexedTriangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// Whether the segment from x meets the box (slabs, a little wider than exact).
inline bool segment_meets_box(const Vec3& x, const Vec3& direction, const Bounds& box) {
  double enter = 0.0, leave = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double slack = 1e-9 * (1.0 + std::abs(box.low[k]) + std::abs(box.high[k]));
    if (direction[k] == 0.0) {
      if (x[k] < box.low[k] - slack || x[k] > box.high[k] + slack) return false;
      continue;
    }
    const double a = (box.low[k] - slack - x[k]) / direction[k],
                 b = (box.high[k] + slack - x[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

/// +1 where the segment x → y leaves through the triangle (goes out on its counter-clockwise side), -1 where
/// it enters, 0 where it misses; nothing where it touches an edge or a corner, or an end lies in the
/// triangle's plane.
inline std::optional<int> crossing(const Vec3& x, const Vec3& y, const Vec3& a, const Vec3& b,
                                   const Vec3& c) {
  const Sign at_x = orient3d(a, b, c, x), at_y = orient3d(a, b, c, y);
  if (at_x == at_y && at_x != Sign::kZero) return 0;
  const Sign s[3] = {orient3d(x, y, a, b), orient3d(x, y, b, c), orient3d(x, y, c, a)};
  const auto any = [&](Sign sign) { return s[0] == sign || s[1] == sign || s[2] == sign; };
  if (any(Sign::kPositive) && any(Sign::kNegative)) return 0;
  if (any(Sign::kZero) || at_x == Sign::kZero || at_y == Sign::kZero) return std::nullopt;
  return at_y == Sign::kPositive ? 1 : -1;
}

/// Winding number at x of a closed mesh that has winding number 0 near `outside`: exact counting of the
/// crossings of a segment. x is taken to be off the surface.
inline int winding_number(const TriangleTree& tree, const Vec3& x, const Vec3& outside, double jitter,
                          RandomInputs& random) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Vec3 y = outside + random.uniform_point(jitter);
    int winding = 0;
    const bool touched =
        tree.find([&](const Bounds& box) { return segment_meets_box(x, y - x, box); },
                  [&](std::uint32_t i) {
                    const auto c = crossing(x, y, tree.corner(i, 0), tree.corner(i, 1), tree.corner(i, 2));
                    if (c) winding += *c;
                    return !c;
                  });
    if (!touched) return winding;
  }
  return std::numeric_limits<int>::max();  // on the surface, most likely
}

}  // namespace penumbra::testing
