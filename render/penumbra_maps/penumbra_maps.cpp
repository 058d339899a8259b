#include "render/penumbra_maps/penumbra_maps.h"

#include <atomic>
#include <optional>

#include "render/center_view/map_receivers.h"
#include "render/center_view/outer_window.h"
#include "render/penumbra_maps/penumbra_map.h"
#include "render/rays/each_receiver.h"

namespace penumbra {

using namespace detail;

MethodResult penumbra_map_visibility(const Scene& scene, const LightShape& shape, const Receivers& receivers,
                                     const PenumbraMapOptions& options, bool keep_textures,
                                     tbb::task_arena& threads, const Progress& progress) {
  MethodResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const AreaLight light = area_light(shape);
  const OuterPenumbra outer(scene, light, receivers);
  std::optional<ShadowMap> casters, surfaces;
  std::optional<PenumbraMap> penumbra;
  std::size_t edges = 0;
  if (!outer.window.empty()) {
    casters.emplace(scene, outer.projection, outer.window, options.map_size, threads);
    surfaces.emplace(scene, outer.projection, outer.window, options.map_size, threads, Drawn::kAll);
    for (std::size_t i = 0; i < receivers.size(); ++i)
      if (receivers.is_present(i))
        if (const auto at = to_map(outer.projection, receivers, i))
          surfaces->raise_empty(at->place, at->height);
    clock.finish("shadow_maps");
    const std::vector<MapEdge> silhouette = map_edges(volume_polygons(scene, shape, {}), outer.projection);
    edges = silhouette.size();
    penumbra.emplace(*surfaces, silhouette, outer.radius, outer.lowest, threads);
    if (keep_textures) out.textures = {casters->picture(), penumbra->picture()};
  }
  clock.finish("penumbra_map");
  for_each_receiver(threads, receivers.size(), progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    double v = above_horizon(light, receivers, i);
    const auto at = v > 0.0 && penumbra ? to_map(outer.projection, receivers, i) : std::nullopt;
    if (at) v *= is_hidden(*casters, *at, options.bias) ? 0.0 : double{penumbra->share(at->place)};
    out.visibility[i] = static_cast<float>(v);
  });
  clock.finish("visibility");
  out.stages = clock.stages();
  out.counts = {{"silhouette_edges", edges}, {"map_texels", casters ? casters->texels() : std::size_t{0}}};
  return out;
}

}  // namespace penumbra
