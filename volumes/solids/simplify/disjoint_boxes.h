// Solids: space divided into boxes, in each of which a surface is changed alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

/// Boxes that have no point in common: of each axis they hold the low end, and not the high one.
class DisjointBoxes {
 public:
  /// Space is cut, across the longest axis, where `share` of the points lie below, as long as a box holds
  /// more than `most` of them. Depends on the points alone. Cost O(n log n).
  DisjointBoxes(std::span<const Vec3> positions, std::vector<std::uint32_t> points, std::size_t most,
                double share);

  std::size_t count() const { return boxes_.size(); }
  /// Infinite where nothing lies beyond.
  const Bounds& box(std::size_t i) const { return boxes_[i]; }
  /// The numbers of the points in a box.
  std::span<const std::uint32_t> points(std::size_t i) const {
    return std::span(points_).subspan(first_[i], first_[i + 1] - first_[i]);
  }
  bool contains(std::size_t i, const Vec3& p) const {
    const Bounds& b = boxes_[i];
    return b.low.x <= p.x && p.x < b.high.x && b.low.y <= p.y && p.y < b.high.y && b.low.z <= p.z &&
           p.z < b.high.z;
  }

 private:
  void divide(std::size_t first, std::size_t last, const Bounds& box);

  std::span<const Vec3> positions_;
  std::size_t most_;
  double share_;
  std::vector<std::uint32_t> points_;
  std::vector<Bounds> boxes_;
  std::vector<std::size_t> first_;  ///< of a box's points, and the end
};

}  // namespace penumbra::detail
