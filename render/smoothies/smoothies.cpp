#include "render/smoothies/smoothies.h"

#include <algorithm>
#include <optional>

#include "render/center_view/outer_window.h"
#include "render/rays/each_receiver.h"
#include "render/smoothies/smoothie_map.h"

namespace penumbra {
namespace {

using namespace detail;

/// The depth of the map's origin over that of a height.
double per_depth(const LightProjection& projection, double height) {
  return 1.0 + projection.nearness() * height;
}

/// Of an outer penumbra on a plane that is infinitely far away, for the mean edge.
double fin_width(const OuterPenumbra& outer, const std::vector<MapEdge>& edges) {
  double sum = 0.0;
  for (const MapEdge& edge : edges) sum += 0.5 * (edge.height_a + edge.height_b);
  const double mean = sum / static_cast<double>(edges.size());
  return outer.radius / outer.projection.nearness() * per_depth(outer.projection, mean);
}

double visible(const SmoothieMap::Fin& fin, const MapReceiver& receiver, const LightProjection& projection) {
  if (!(fin.alpha < 1.0f && fin.height > receiver.height)) return 1.0;
  const double ratio = per_depth(projection, receiver.height) / per_depth(projection, fin.height);
  const double t = std::min(1.0, double{fin.alpha} / (1.0 - ratio));
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

MethodResult smoothie_visibility(const Scene& scene, const LightShape& shape, const Receivers& receivers,
                                 const SmoothieOptions& options, bool keep_textures, tbb::task_arena& threads,
                                 const Progress& progress) {
  MethodResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const AreaLight light = area_light(shape);
  const OuterPenumbra outer(scene, light, receivers);
  const std::vector<MapEdge> edges = map_edges(volume_polygons(scene, shape, {}), outer.projection);
  std::optional<ShadowMap> casters;
  std::optional<SmoothieMap> fins;
  if (!outer.window.empty() && !edges.empty()) {
    casters.emplace(scene, outer.projection, outer.window, options.map_size, threads);
    clock.finish("shadow_map");
    fins.emplace(*casters, edges, options.width * fin_width(outer, edges), threads);
    if (keep_textures) out.textures = {casters->picture(), fins->picture()};
  }
  clock.finish("smoothies");
  for_each_receiver(threads, receivers.size(), progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    double v = above_horizon(light, receivers, i);
    const auto at = v > 0.0 && fins ? to_map(outer.projection, receivers, i) : std::nullopt;
    if (at)
      v *= is_hidden(*casters, *at, options.bias) ? 0.0 : visible(fins->at(at->place), *at, outer.projection);
    out.visibility[i] = static_cast<float>(v);
  });
  clock.finish("visibility");
  out.stages = clock.stages();
  out.counts = {{"silhouette_edges", edges.size()},
                {"map_texels", casters ? casters->texels() : std::size_t{0}}};
  return out;
}

}  // namespace penumbra
