// Silhouette method, step edges: a mesh's points in groups with boxes.
//
// In: the points of a mesh, once. Out: for any light, the box of the points in the light's frame. Most points
// are not looked at: a group whose own box lies within the box found so far adds nothing.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/silhouette/edges/unit_light.h"

namespace penumbra::detail {

class PointGroups {
 public:
  PointGroups() = default;
  /// Points that follow on each other make a group. Refers to the points. Cost O(points), on all cores.
  explicit PointGroups(std::span<const Vec3> points);
  /// The smallest box of all points in the light's frame. Cost O(groups), and the points of the groups that
  /// reach its sides: few where neighbors in the array are neighbors in space.
  Bounds box_in(const UnitLight& light) const;
  std::size_t bytes() const { return groups_.size() * sizeof(Bounds); }

 private:
  std::span<const Vec3> points_;
  std::vector<Bounds> groups_;
};

}  // namespace penumbra::detail
