#include "penumbra/render/scene/scene.h"

#include <charconv>

#include "penumbra/mesh/error.h"
#include "render/support/nearest_word.h"

namespace penumbra {

Bounds Scene::bounds() const {
  Bounds bounds;
  for (const SceneObject& object : objects) bounds.add(object.mesh.bounds());
  return bounds;
}

Bounds Scene::caster_bounds() const {
  Bounds bounds;
  for (const SceneObject& object : objects)
    if (object.casts) bounds.add(object.mesh.bounds());
  return bounds;
}

std::size_t Scene::light_index(std::string_view name_or_index) const {
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (!lights[i].name.empty() && lights[i].name == name_or_index) return i;
  std::size_t index = 0;
  const char* end = name_or_index.data() + name_or_index.size();
  const auto [stop, error] = std::from_chars(name_or_index.data(), end, index);
  if (error == std::errc() && stop == end && index < lights.size()) return index;
  std::vector<std::string> names;
  for (const Light& light : lights) names.push_back(light.name);
  std::string known;
  for (std::size_t i = 0; i < lights.size(); ++i)
    known +=
        (i ? ", " : "") + std::to_string(i) + (lights[i].name.empty() ? "" : " (" + lights[i].name + ")");
  throw UsageError("the scene has no light '" + std::string(name_or_index) + "'" +
                   did_you_mean(name_or_index, names) + "; it has " + known);
}

}  // namespace penumbra
