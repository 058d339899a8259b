#include "apps/viewer/handles/aim.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

// Along the ray, or infinity (T. Möller, B. Trumbore, "Fast, minimum storage ray/triangle intersection",
// 1997).
double distance_to(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& direction) {
  const Vec3 u = b - a, v = c - a, p = glm::cross(direction, v);
  const double determinant = glm::dot(u, p);
  if (determinant == 0.0) return INFINITY;
  const Vec3 t = from - a, q = glm::cross(t, u);
  const double x = glm::dot(t, p) / determinant, y = glm::dot(direction, q) / determinant;
  const double along = glm::dot(v, q) / determinant;
  return x >= 0.0 && y >= 0.0 && x + y <= 1.0 && along > 0.0 ? along : INFINITY;
}

}  // namespace

std::optional<Vec3> lit_point(const Scene& scene, const DiskLight& light) {
  const Vec3 axis = light_frame(light).w;
  double nearest = INFINITY;
  for (const SceneObject& object : scene.objects) {
    const auto positions = object.mesh.positions();
    for (const IndexedTriangle& t : object.mesh.triangles())
      nearest = std::min(nearest,
                         distance_to(positions[t[0]], positions[t[1]], positions[t[2]], light.center, axis));
  }
  if (std::isinf(nearest) && !scene.caster_bounds().empty())
    nearest = glm::dot(scene.caster_bounds().center() - light.center, axis);
  if (!(nearest > 0.0) || std::isinf(nearest)) return std::nullopt;
  return light.center + nearest * axis;
}

}  // namespace penumbra::viewer
