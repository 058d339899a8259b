#include "render/scene/gltf/gltf_area_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"
#include "render/scene/gltf/gltf_nodes.h"
#include "render/scene/scene_node.h"

namespace penumbra::detail {
namespace {

double number_of(const tinygltf::Value& object, const char* key, double usual) {
  return object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble() : usual;
}

std::string text_of(const tinygltf::Value& object, const char* key) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : std::string();
}

Vec3 radiance_of(const tinygltf::Value& light) {
  constexpr double kUsual = 1000.0;
  Vec3 color(1.0);
  if (light.Has("color") && light.Get("color").IsArray() && light.Get("color").ArrayLen() == 3)
    for (int k = 0; k < 3; ++k)
      if (const tinygltf::Value& part = light.Get("color").Get(k); part.IsNumber())
        color[k] = std::max(part.GetNumberAsDouble(), 0.0);
  const Vec3 radiance = color * std::max(number_of(light, "intensity", kUsual), 0.0);
  return largest_component(radiance) <= 1e30 ? radiance : Vec3(kUsual);  // NaN, too
}

/// nullptr where the node has no area light.
const tinygltf::Value* light_of(const GltfFile& file, const tinygltf::Node& node, const std::string& where) {
  const auto reference = node.extensions.find(kAreaLights);
  if (reference == node.extensions.end() || !reference->second.Has("light")) return nullptr;
  const tinygltf::Value& number = reference->second.Get("light");
  const int i = number.IsNumber() ? number.GetNumberAsInt() : -1;
  const auto extension = file.model.extensions.find(kAreaLights);
  if (extension == file.model.extensions.end() || !extension->second.Has("lights") ||
      !extension->second.Get("lights").IsArray() || i < 0 ||
      static_cast<std::size_t>(i) >= extension->second.Get("lights").ArrayLen())
    file.fail(where, "has an area light that does not exist", "export it again");
  const tinygltf::Value& light = extension->second.Get("lights").Get(i);
  if (!light.IsObject()) file.fail(where, "has an area light that is no object", "export it again");
  return &light;
}

}  // namespace

std::optional<Light> read_gltf_area_light(const GltfFile& file, const tinygltf::Node& node,
                                          const std::string& where, const Transform& world,
                                          GltfNotes& notes) {
  const tinygltf::Value* light = light_of(file, node, where);
  if (!light) return std::nullopt;
  const std::string type = text_of(*light, "type");
  if (type != "rect" && type != "disk") {
    notes.ignore("lights of unknown types");
    return std::nullopt;
  }
  double scale = 0.0;
  for (const Vec3& column : world.columns) scale = std::max(scale, glm::length(column));
  const double size = scale * number_of(*light, "size", 1.0);
  const double aspect =
      type == "rect" && light->Has("rect") ? number_of(light->Get("rect"), "aspect", 1.0) : 1.0;
  if (!(size > 0.0 && size <= 1e30 && aspect > 0.0 && size * aspect <= 1e30))
    file.fail(where, "has an area light of size " + to_text(size) + " and aspect " + to_text(aspect),
              "give numbers above 0");
  Light out{.name = text_of(*light, "name"), .shape = {}, .radiance = radiance_of(*light)};
  const Vec3 normal = forward(world), tangent = scaled_to_one(world.columns[0]);
  if (type == "disk") {
    out.shape = DiskLight{world.translation, normal, 0.5 * size};
  } else if (glm::length(glm::cross(normal, tangent)) > 1e-9) {
    out.shape = RectangleLight{world.translation, normal, tangent, {0.5 * size * aspect, 0.5 * size}};
  } else {
    notes.ignore("flattened lights");
    return std::nullopt;
  }
  return out;
}

}  // namespace penumbra::detail
