#include "apps/cli/bake/bake_source.h"

#include <algorithm>

#include "apps/cli/digest.h"
#include "apps/cli/made_by.h"
#include "apps/cli/sun/surface.h"
#include "apps/common/stats.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

std::string digest_of(const Scene& scene, const TextureAtlas* atlas) {
  Digest digest;
  for (const SceneObject& object : scene.objects) {
    digest.add(std::uint64_t{object.casts});
    for (const Vec3& p : object.mesh.positions())
      for (int k = 0; k < 3; ++k) digest.add(p[k]);
    for (const IndexedTriangle& t : object.mesh.triangles())
      for (const std::uint32_t v : t) digest.add(std::uint64_t{v});
  }
  if (atlas)
    for (const std::vector<FaceUv>& faces : atlas->uv)
      for (const FaceUv& uv : faces)
        for (const glm::dvec2& p : uv) digest.add(p.x), digest.add(p.y);
  return digest.text();
}

}  // namespace

Scene chosen_scene(const BakeArguments& arguments, Scene scene) {
  if (arguments.lights.empty()) return scene;
  std::vector<Light> lights;
  for (const std::string& name : arguments.lights) {
    const Light& light = scene.lights[scene.light_index(name)];
    if (std::ranges::find(lights, light) == lights.end()) lights.push_back(light);
  }
  scene.lights = std::move(lights);
  return scene;
}

std::vector<std::size_t> object_numbers(const Scene& scene, const std::vector<std::string>& names) {
  std::vector<std::size_t> numbers;
  for (const std::string& name : names) {
    for (const std::size_t number : objects_named(scene, name))
      if (std::ranges::find(numbers, number) == numbers.end()) numbers.push_back(number);
  }
  return numbers;
}

std::vector<std::string> channel_names(const Scene& scene, BakeQuantity quantity) {
  if (quantity == BakeQuantity::kIrradiance) return {"R", "G", "B"};
  if (scene.lights.size() == 1) return {"visibility"};
  std::vector<std::string> names;
  for (const Light& light : scene.lights) names.push_back("visibility." + light.name);
  return names;
}

nlohmann::json settings_of(const BakeArguments& arguments, const Scene& scene, const TextureAtlas* atlas) {
  nlohmann::json settings = {{"version", PENUMBRA_VERSION},
                             {"scene", digest_of(scene, atlas)},
                             {"about", metadata_of(scene)},
                             {"quantity", arguments.quantity},
                             {"method", arguments.visibility.method},
                             {"options", to_json(arguments.visibility.options)},
                             {"back", object_numbers(scene, arguments.backs)}};
  if (atlas) {
    settings["texels"] = {atlas->width, atlas->height};
    settings["tile"] = arguments.map.tile;
    settings["samples"] = arguments.map.samples;
  } else {
    settings["to"] = arguments.to;
    settings["object"] = object_numbers(scene, arguments.objects);
    settings["side"] = arguments.faces.side;
    settings["part"] = arguments.faces.part;
  }
  return settings;
}

}  // namespace penumbra::apps
