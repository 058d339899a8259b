#include "apps/cli/made_by.h"

#include <algorithm>

#include "apps/common/stats.h"

namespace penumbra::apps {
namespace {

using nlohmann::json;

constexpr const char* kVersion = "penumbraVersion";
constexpr const char* kMethod = "penumbraMethod";
constexpr const char* kOptions = "penumbraOptions";
constexpr const char* kScene = "penumbraScene";
constexpr const char* kLights = "penumbraLights";
constexpr const char* kCamera = "penumbraCamera";
constexpr const char* kPicture = "penumbraPicture";

json to_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

struct ShapeToJson {
  json operator()(const DiskLight& disk) const {
    return {{"center", to_json(disk.center)}, {"normal", to_json(disk.normal)}, {"radius", disk.radius}};
  }
  json operator()(const RectangleLight& rectangle) const {
    return {{"center", to_json(rectangle.center)},
            {"normal", to_json(rectangle.normal)},
            {"tangent", to_json(rectangle.tangent)},
            {"half_extents", {rectangle.half_extents.x, rectangle.half_extents.y}}};
  }
  json operator()(const DistantLight& distant) const {
    return {{"direction", to_json(distant.direction)}, {"angle_degrees", distant.angle_degrees}};
  }
};

json to_json(const Light& light) {
  json entry = std::visit(ShapeToJson{}, light.shape);
  entry["shape"] = name_of(light.shape);
  entry["radiance"] = to_json(light.radiance);
  if (!light.name.empty()) entry["name"] = light.name;
  return entry;
}

/// One line of ASCII, the shortest decimals that read back exactly.
std::string text_of(const json& value) {
  return value.dump(-1, ' ', true, json::error_handler_t::replace);
}

std::string found(const Metadata& metadata, const char* key) {
  const auto at = metadata.find(key);
  return at == metadata.end() ? std::string() : at->second;
}

/// Null where the text is no JSON.
json parsed(const std::string& text) {
  return json::accept(text) ? json::parse(text) : json();
}

bool is_usual(const std::string& method, const std::string& option, const json& value) {
  if (option == "samples" || option == "seed") return false;
  for (const MethodInfo& info : methods())
    for (const OptionSchema& schema : info.options)
      if (info.name == method && schema.name == option)
        return apps::to_json(OptionValues{{option, schema.usual}})[option] == value;
  return false;
}

}  // namespace

Metadata metadata_of(const Scene& scene) {
  json lights = json::array();
  for (const Light& light : scene.lights) lights.push_back(to_json(light));
  const json camera = {{"eye", to_json(scene.camera.eye)},
                       {"target", to_json(scene.camera.target)},
                       {"up", to_json(scene.camera.up)},
                       {"fov_y_degrees", scene.camera.fov_y_degrees}};
  return {{kLights, text_of(lights)}, {kCamera, text_of(camera)}};
}

Metadata metadata_of(const Scene& scene, const std::string& path, const RenderResult& result) {
  Metadata metadata = metadata_of(scene);
  metadata[kVersion] = PENUMBRA_VERSION;
  metadata[kMethod] = result.method;
  metadata[kOptions] = text_of(apps::to_json(result.options));
  metadata[kScene] = path;
  metadata[kPicture] =
      text_of({{"ambient", to_json(scene.picture.ambient)}, {"antialias", result.antialias}});
  return metadata;
}

std::string made_by(const Metadata& metadata) {
  const std::string method = found(metadata, kMethod);
  if (method.empty()) return "does not say what made it";
  std::string options;
  const json values = parsed(found(metadata, kOptions));
  for (const auto& [name, value] : values.items())
    if (!is_usual(method, name, value))
      options += (options.empty() ? " (" : ", ") + name + " " +
                 (value.is_string() ? value.get<std::string>() : text_of(value));
  if (!options.empty()) options += ")";
  return method + options + " of " + found(metadata, kScene) + " by penumbra " + found(metadata, kVersion);
}

json made_by_json(const Metadata& metadata) {
  if (found(metadata, kMethod).empty()) return nullptr;
  return {{"method", found(metadata, kMethod)},         {"options", parsed(found(metadata, kOptions))},
          {"scene", found(metadata, kScene)},           {"lights", parsed(found(metadata, kLights))},
          {"camera", parsed(found(metadata, kCamera))}, {"version", found(metadata, kVersion)}};
}

std::vector<std::string> differences(const Metadata& a, const Metadata& b) {
  std::vector<std::string> names;
  for (const auto& [key, name] : {std::pair{kLights, "lights"}, std::pair{kCamera, "camera"}})
    if (a.contains(key) && b.contains(key) && a.at(key) != b.at(key)) names.emplace_back(name);
  return names;
}

}  // namespace penumbra::apps
