#include "render/light/area_light.h"

#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra {

Vec3 AreaLight::direction_to_light(const Vec3& world) const {
  return {glm::dot(world, axes.u), glm::dot(world, axes.v), glm::dot(world, axes.w)};
}

Vec3 AreaLight::to_light(const Vec3& world) const {
  return distant ? Vec3(0.0, 0.0, 1.0) : direction_to_light(world - center);
}

AreaLight area_light(const LightShape& shape) {
  if (const auto* disk = std::get_if<DiskLight>(&shape))
    return {light_frame(*disk), disk->center, glm::dvec2(disk->radius), true};
  if (const auto* distant = std::get_if<DistantLight>(&shape)) {
    const LightFrame axes = light_frame(DiskLight{.normal = distant->direction});
    return {axes, -axes.w, glm::dvec2(CircularLight(*distant).radius), true, true};
  }
  const auto& rectangle = std::get<RectangleLight>(shape);
  const Vec3 w = detail::unit(rectangle.normal), t = detail::unit(rectangle.tangent);
  const Vec3 v = glm::normalize(glm::cross(w, t));
  return {{glm::cross(v, w), v, w}, rectangle.center, rectangle.half_extents, false};
}

}  // namespace penumbra
