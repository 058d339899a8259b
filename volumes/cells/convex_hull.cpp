#include "volumes/cells/convex_hull.h"

#include "penumbra/volumes/predicates/predicates.h"
#include "volumes/cells/quickhull.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra::detail {

namespace {

class CartesianPoints {
 public:
  explicit CartesianPoints(std::span<const Vec3> points) : points_(points) {}

  int count() const { return static_cast<int>(points_.size()); }
  const Vec3& rounded(int i) const { return points_[i]; }
  Sign orient3d(int a, int b, int c, int d) const {
    return penumbra::orient3d(points_[a], points_[b], points_[c], points_[d]);
  }
  bool collinear(int a, int b, int c) const { return detail::collinear(points_[a], points_[b], points_[c]); }

 private:
  std::span<const Vec3> points_;
};

}  // namespace

std::vector<IndexedTriangle> convex_hull(std::span<const Vec3> points) {
  const CartesianPoints cartesian(points);
  return Quickhull(cartesian).run();
}

}  // namespace penumbra::detail
