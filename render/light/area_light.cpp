#include "render/light/area_light.h"

#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "penumbra/mesh/error.h"

namespace penumbra {

Vec3 AreaLight::direction_to_light(const Vec3& world) const {
  return {glm::dot(world, axes.u), glm::dot(world, axes.v), glm::dot(world, axes.w)};
}

Vec3 AreaLight::to_light(const Vec3& world) const {
  return direction_to_light(world - center);
}

AreaLight area_light(const Scene& scene) {
  if (!scene.rectangle)
    return {light_frame(scene.light), scene.light.center, glm::dvec2(scene.light.radius), true};
  const Vec3 w = detail::unit(scene.light.normal), t = detail::unit(scene.rectangle->tangent);
  const Vec3 v = glm::normalize(glm::cross(w, t));
  return {{glm::cross(v, w), v, w}, scene.light.center, scene.rectangle->half_extents, false};
}

const DiskLight& require_disk(const Scene& scene, const std::string& who) {
  if (scene.rectangle)
    throw UsageError(who +
                     " needs a disk light and the scene's is a rectangle; give it \"shape\": \"disk\" and a "
                     "radius");
  return scene.light;
}

}  // namespace penumbra
