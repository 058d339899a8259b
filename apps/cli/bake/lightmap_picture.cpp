#include "apps/cli/bake/lightmap_picture.h"

#include <glm/geometric.hpp>
#include <numbers>

#include "penumbra/render/renderer.h"

namespace penumbra::apps {
namespace {

/// One list a channel, one value a pixel.
std::vector<std::vector<float>> looked_up(const BakeSource& source, const TextureAtlas& atlas,
                                          const Lightmap& map, const SurfaceBuffer& surface) {
  std::vector<std::vector<float>> out(map.channels.size(), std::vector<float>(surface.size(), 0.0f));
  for (std::size_t i = 0; i < surface.size(); ++i) {
    if (!surface.hit(i)) continue;
    const auto object = static_cast<std::size_t>(surface.object[i]);
    const Vec3 lit_side = source.normal_of(static_cast<std::uint32_t>(object), surface.face[i]);
    if (!atlas.has(object) || !(glm::dot(lit_side, surface.normal[i]) > 0.0)) continue;
    const TriangleMesh& mesh = source.casters.objects()[object].mesh;
    const glm::dvec2 at = place_in_atlas(atlas, mesh, object, surface.face[i], surface.position[i]);
    for (std::size_t c = 0; c < out.size(); ++c) out[c][i] = static_cast<float>(map.look_up(c, at));
  }
  return out;
}

}  // namespace

Image picture_by_lightmap(const Scene& scene, const BakeSource& source, const TextureAtlas& atlas,
                          const Lightmap& map, int width, int height, int threads) {
  Renderer renderer(scene, threads);
  RenderResult seen = renderer.render({.method = "none", .width = width, .height = height});
  const auto values = looked_up(source, atlas, map, seen.surface);
  if (source.quantity == BakeQuantity::kVisibility) return renderer.shade_again(values);
  const char* const names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& channel = seen.image.channels.at(names[c]);
    for (std::size_t i = 0; i < channel.size(); ++i) {
      if (!seen.surface.hit(i)) continue;
      const SceneObject& object = scene.objects[static_cast<std::size_t>(seen.surface.object[i])];
      const double albedo = object.albedo_of(seen.surface.face[i])[c];
      channel[i] = static_cast<float>(albedo / std::numbers::pi * values[static_cast<std::size_t>(c)][i]);
    }
  }
  std::erase_if(seen.image.channels, [](const auto& channel) {
    return channel.first.starts_with("visibility") || channel.first.starts_with("region");
  });
  return std::move(seen.image);
}

}  // namespace penumbra::apps
