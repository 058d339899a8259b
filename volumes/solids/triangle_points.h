// Solids: points of triangles at which a surface is judged, each once where triangles share it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

struct PointPattern {
  bool corners = true;
  /// Of each side, from one end on; with f also 1 - f.
  std::vector<double> sides;
  /// Barycentric coordinates.
  std::vector<std::array<double, 3>> inside;
};

/// Corners, middles of sides and of the triangle.
PointPattern middle_points();
/// n + 1 points on each side, and those of the same lattice between.
PointPattern lattice_points(int n);

class TrianglePoints {
 public:
  /// One a triangle: bits 0 to 2 stand for its corners, 3 to 5 for its sides, 6 for its inside. Those that
  /// are set are left out.
  using Known = std::vector<std::uint8_t>;
  static constexpr std::uint8_t kWhole = 127;

  /// Refers to its arguments. Cost O(n log n), on the calling arena's threads.
  TrianglePoints(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                 const PointPattern& pattern, const Known& known = {});

  /// Of corners, sides and triangles, in this order; neighbors are near each other.
  const std::vector<Vec3>& points() const { return points_; }
  /// Bits as those of Known, of the points of triangle i that have a fault. `has_fault` is asked by a point's
  /// number.
  template <class HasFault>
  std::uint8_t faults(std::size_t i, const HasFault& has_fault) const {
    unsigned out = 0;
    for_each_point(i, [&](std::size_t p, unsigned part, const std::array<double, 3>&) {
      if (has_fault(p)) out |= 1u << part;
    });
    return static_cast<std::uint8_t>(out);
  }
  /// Corners of triangle i, as bits, that lie near a point of it with a fault.
  template <class HasFault>
  std::uint8_t corners_near_faults(std::size_t i, const HasFault& has_fault) const {
    unsigned out = 0;
    for_each_point(i, [&](std::size_t p, unsigned, const std::array<double, 3>& weights) {
      if (!has_fault(p)) return;
      for (unsigned k = 0; k < 3; ++k) out |= weights[k] > kNear ? 1u << k : 0u;
    });
    return static_cast<std::uint8_t>(out);
  }

 private:
  /// A point is near the corners of which it has more than this, by barycentric coordinates.
  static constexpr double kNear = 0.25;
  using Side = std::array<std::uint32_t, 2>;

  static Side side(const IndexedTriangle& t, unsigned k) {
    return {std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])};
  }
  static constexpr std::size_t kNone = ~std::size_t{0};
  template <class T>
  static std::size_t place(const std::vector<T>& list, const T& item) {
    const auto at = std::lower_bound(list.begin(), list.end(), item);
    return at != list.end() && *at == item ? static_cast<std::size_t>(at - list.begin()) : kNone;
  }

  /// Calls visit(number, bit of its part, barycentric coordinates) for each point of triangle i that is not
  /// left out.
  template <class Visit>
  void for_each_point(std::size_t i, const Visit& visit) const {
    const IndexedTriangle& t = triangles_[i];
    for (unsigned k = 0; k < 3; ++k) {
      const unsigned next = (k + 1) % 3;
      std::array<double, 3> weights{};
      weights[k] = 1.0;
      if (const std::size_t at = place(corners_, t[k]); at != kNone) visit(at, k, weights);
      const std::size_t at = place(sides_, side(t, k));
      for (std::size_t s = 0; at != kNone && s < pattern_.sides.size(); ++s) {
        weights[next] = t[k] < t[next] ? pattern_.sides[s] : 1.0 - pattern_.sides[s];
        weights[k] = 1.0 - weights[next];
        visit(corners_.size() + pattern_.sides.size() * at + s, 3 + k, weights);
      }
    }
    for (std::size_t p = 0; inside_[i] != kNone && p < pattern_.inside.size(); ++p)
      visit(inside_[i] + p, 6u, pattern_.inside[p]);
  }

  std::span<const IndexedTriangle> triangles_;
  const PointPattern& pattern_;
  std::vector<std::uint32_t> corners_;
  std::vector<Side> sides_;
  std::vector<Vec3> points_;
  std::vector<std::size_t> inside_;  ///< one a triangle: its first point, or kNone
};

}  // namespace penumbra::detail
