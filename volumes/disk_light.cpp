#include "penumbra/volumes/disk_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "mesh/vectors.h"

namespace penumbra {

CircularLight::CircularLight(const DistantLight& light)
    : center(-light.direction),
      weight(0.0),
      normal(light.direction),
      radius(light.angle_degrees >= 0.0 && light.angle_degrees < 180.0
                 ? std::tan(0.5 * glm::radians(light.angle_degrees))
                 : std::numeric_limits<double>::quiet_NaN()) {}

LightFrame light_frame(const CircularLight& light) {
  const Vec3 w = detail::unit(light.normal);
  const Vec3 u = detail::unit_perpendicular(w);
  return {u, glm::cross(w, u), w};
}

Vec3 way_to_center(const CircularLight& light, const Vec3& p) {
  return light.is_distant() ? detail::unit(light.center) : light.center - p;
}

ExtremePoints extreme_points(const CircularLight& light, const Vec3& plane_normal) {
  const Vec3 m = detail::unit(light.normal);
  const Vec3 n = detail::scaled_to_one(plane_normal);
  // m × (N × m) is N - (N·m)m without the cancellation where N is nearly parallel to m.
  const Vec3 perpendicular = glm::cross(m, glm::cross(n, m));
  const double length = glm::length(perpendicular);
  const Vec3 center = light.is_distant() ? detail::unit(light.center) : light.center;
  if (!(length > 0.0)) return {center, center};
  const Vec3 offset = (light.radius / length) * perpendicular;
  return {center + offset, center - offset};
}

bool is_behind(const CircularLight& light, const Vec3& point) {
  return !light.is_distant() && glm::dot(point - light.center, light.normal) <= 0.0;
}

}  // namespace penumbra
