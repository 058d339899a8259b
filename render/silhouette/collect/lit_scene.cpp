#include "render/silhouette/collect/lit_scene.h"

#include <algorithm>

#include "mesh/vectors.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {
namespace {

double extent_of(const Bounds& box, const UnitLight& light) {
  double extent = 1.0;
  for (int corner = 0; corner < 8; ++corner)
    extent = std::max(extent, largest_component(light.point({corner & 1 ? box.high.x : box.low.x,
                                                             corner & 2 ? box.high.y : box.low.y,
                                                             corner & 4 ? box.high.z : box.low.z})));
  return extent;
}

/// Some roundings of the world's coordinates. Far from everything the light's plane is certain to be missed.
double rounding_at_light(const Bounds& box, const UnitLight& light) {
  if (light.is_projective() || box.empty()) return 0.0;
  const double most = std::max(
      {largest_component(box.low), largest_component(box.high), largest_component(light.light().center)});
  return 0x1p-50 * most * light.per_radius();
}

}  // namespace

LitScene::LitScene(const Scene& lit_scene, const UnitLight& unit_light, const SceneEdges& edges,
                   const Bounds& asked_about, std::span<const char> flags)
    : scene(lit_scene),
      light(unit_light),
      cannot_occlude(flags),
      boxes(scene.objects.size()),
      extent(extent_of(asked_about, light)),
      depth(rounding_at_light(asked_about, light)) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.casts || object.mesh.empty() || (!cannot_occlude.empty() && cannot_occlude[i])) continue;
    boxes[i] = edges.points(i).box_in(light);
    all_in_front = all_in_front && boxes[i].low.z > depth;
  }
}

}  // namespace penumbra::detail
