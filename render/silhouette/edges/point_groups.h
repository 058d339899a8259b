// A mesh's points in groups with boxes: its box in another frame without a look at every point.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

class UnitLight;

class PointGroups {
 public:
  PointGroups() = default;
  /// Refers to the points; those that follow on each other make a group. Cost O(points), on all cores.
  explicit PointGroups(std::span<const Vec3> points);
  /// The smallest box in the light's frame. Cost O(groups) and the points of those that reach its sides, few
  /// where neighbors in the array are neighbors in space.
  Bounds box_in(const UnitLight& light) const;
  std::size_t bytes() const { return groups_.size() * sizeof(Bounds); }

 private:
  std::span<const Vec3> points_;
  std::vector<Bounds> groups_;
};

}  // namespace penumbra::detail
