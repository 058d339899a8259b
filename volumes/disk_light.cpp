#include "penumbra/volumes/disk_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "mesh/vectors.h"

namespace penumbra {

CircularLight::CircularLight(const DistantLight& light)
    : center(-light.direction),
      weight(0.0),
      normal(light.direction),
      radius(std::tan(0.5 * glm::radians(light.angle_degrees))) {}

LightFrame light_frame(const DiskLight& light) {
  const Vec3 w = detail::unit(light.normal);
  const Vec3 u = detail::unit_perpendicular(w);
  return {u, glm::cross(w, u), w};
}

ExtremePoints extreme_points(const DiskLight& light, const Vec3& plane_normal) {
  const Vec3 m = detail::unit(light.normal);
  const Vec3 n = detail::scaled_to_one(plane_normal);
  // m × (N × m) is N - (N·m)m without the cancellation where N is nearly parallel to m.
  const Vec3 perpendicular = glm::cross(m, glm::cross(n, m));
  const double length = glm::length(perpendicular);
  if (!(length > 0.0)) return {light.center, light.center};
  const Vec3 offset = (light.radius / length) * perpendicular;
  return {light.center + offset, light.center - offset};
}

bool is_behind(const DiskLight& light, const Vec3& point) {
  return glm::dot(point - light.center, light.normal) <= 0.0;
}

}  // namespace penumbra
