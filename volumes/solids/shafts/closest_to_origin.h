// The point of a growing simplex that is closest to the origin, for the distance of convex sets.
#pragma once

#include <array>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

class ClosestToOrigin {
 public:
  /// Adds a corner and drops those that the closest point does not need. False where the origin is inside of
  /// the simplex, or the corner is there already.
  bool add(const Vec3& corner);
  /// The closest point.
  const Vec3& point() const { return point_; }

 private:
  void closest_on_segment();
  void closest_on_triangle();
  bool closest_on_tetrahedron();

  std::array<Vec3, 4> corners_;
  int count_ = 0;
  Vec3 point_{0.0};
};

}  // namespace penumbra::detail
