#include "apps/cli/study/peers/scene_export.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "apps/cli/study/page/base64.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;
static_assert(std::endian::native == std::endian::little);

json numbers_of(const Vec3& v) {
  return json::array({v.x, v.y, v.z});
}

template <typename T>
std::string packed(const std::vector<T>& values) {
  return base64_of(std::string_view(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size()));
}

json object_json(const SceneObject& object) {
  std::vector<float> positions;
  for (const Vec3& p : object.mesh.positions())
    for (const double value : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(value));
  std::vector<std::uint32_t> corners;
  for (const IndexedTriangle& t : object.mesh.triangles())
    for (const auto corner : t) corners.push_back(static_cast<std::uint32_t>(corner));
  return {{"casts", object.casts}, {"positions", packed(positions)}, {"triangles", packed(corners)}};
}

json camera_json(const Camera& camera, const Bounds& bounds) {
  const Vec3 forward = glm::normalize(camera.target - camera.eye);
  const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
  const double far = glm::length(bounds.center() - camera.eye) + bounds.radius();
  return {{"eye", numbers_of(camera.eye)},
          {"forward", numbers_of(forward)},
          {"right", numbers_of(right)},
          {"up", numbers_of(glm::cross(right, forward))},
          {"fov_y_degrees", camera.fov_y_degrees},
          {"near", 1e-4 * far},
          {"far", far}};
}

json frame_json(const Vec3& normal) {
  const Vec3 m = glm::normalize(normal);
  const Vec3 u = glm::normalize(glm::cross(m, std::abs(m.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
  return {{"normal", numbers_of(m)}, {"u", numbers_of(u)}, {"v", numbers_of(glm::cross(u, m))}};
}

struct LightJson {
  Bounds casters;

  json operator()(const DiskLight& light) const {
    json out = frame_json(light.normal);
    out["kind"] = "disk";
    out["center"] = numbers_of(light.center);
    out["radius"] = light.radius;
    out["distance"] = glm::length(light.center - casters.center());
    return out;
  }
  json operator()(const DistantLight& light) const {
    json out = frame_json(light.direction);
    out["kind"] = "distant";
    out["center"] = numbers_of(casters.center());
    out["angle_degrees"] = light.angle_degrees;
    out["distance"] = 2.0 * casters.radius();
    return out;
  }
  json operator()(const RectangleLight&) const { throw std::logic_error("a rectangle is exported"); }
};

}  // namespace

json scene_export(const StudyCase& seen) {
  const LightJson light{seen.scene.caster_bounds()};
  json out = {{"width", seen.view.width},
              {"height", seen.view.height},
              {"camera", camera_json(seen.scene.camera, seen.scene.bounds())},
              {"light", std::visit(light, seen.scene.lights.front().shape)},
              {"objects", json::array()}};
  for (const SceneObject& object : seen.scene.objects) out["objects"].push_back(object_json(object));
  return out;
}

}  // namespace penumbra::apps
