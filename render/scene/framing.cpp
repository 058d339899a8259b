#include "render/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "mesh/vectors.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {
namespace {

/// Along one axis of the picture. With a the eye's coordinate along the axis, c its depth and t the frustum's
/// half size, the point p lies inside where a - t c ≥ p.a - t p.c and -a - t c ≥ -p.a - t p.c.
struct Side {
  double over = -std::numeric_limits<double>::infinity(), under = over;

  void add(double along, double deep) {
    over = std::max(over, along - deep);
    under = std::max(under, -along - deep);
  }
  /// Twice the greatest t c.
  double deepest() const { return -(over + under); }
  double middle() const { return 0.5 * over - 0.5 * under; }
};

}  // namespace

Camera camera_that_sees(std::span<const Vec3> points, const Vec3& forward, const Vec3& up,
                        const Frustum& frustum) {
  const Vec3 origin = bounds_of(points).center();  // digits far from the origin of the world
  const Vec3 f = unit(forward), r = unit(glm::cross(f, up)), u = glm::cross(r, f);
  Side across, upward;
  double nearest = std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Vec3& world : points) {
    const Vec3 p = world - origin;
    const double depth = glm::dot(p, f);
    across.add(glm::dot(p, r), frustum.half_width * depth);
    upward.add(glm::dot(p, u), frustum.half_height * depth);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const double depth =
      std::min({0.5 * across.deepest() / frustum.half_width, 0.5 * upward.deepest() / frustum.half_height,
                nearest - 0.5 * (farthest - nearest)});
  const Vec3 eye = origin + across.middle() * r + upward.middle() * u + depth * f;
  return {.eye = eye,
          .target = eye + (0.5 * nearest + 0.5 * farthest - depth) * f,
          .up = up,
          .fov_y_degrees = std::atan(frustum.half_height) * 360.0 / std::numbers::pi};
}

}  // namespace penumbra::detail
