#include "render/layered_attenuation/layered_attenuation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/center_view/outer_window.h"
#include "render/rays/each_receiver.h"

namespace penumbra {

using namespace detail;

MethodResult layered_attenuation(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                                 const AttenuationOptions& options, bool keep_textures,
                                 tbb::task_arena& threads, const Progress& progress) {
  MethodResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const OuterPenumbra outer(scene, light, receivers);
  std::optional<AttenuationMap> map;
  if (!outer.window.empty()) {
    map.emplace(scene, outer.projection, outer.window, outer.lowest, outer.top, light.disk, options, threads);
    if (keep_textures) out.textures = {map->picture()};
  }
  clock.finish("attenuation_map");
  for_each_receiver(threads, receivers.size(), progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    double v = above_horizon(light, receivers, i);
    const auto at = v > 0.0 && map ? to_map(outer.projection, receivers, i) : std::nullopt;
    if (at && outer.window.holds(at->place)) {
      const double slope = std::hypot(at->rise.x, at->rise.y);
      // What is below the horizon does not see the surface either.
      v = std::min(v, map->share(at->place, at->height, slope).value_or(0.0));
    }
    out.visibility[i] = static_cast<float>(v);
  });
  clock.finish("visibility");
  out.stages = clock.stages();
  out.counts = {{"layers", map ? map->layers() : std::size_t{0}}};
  return out;
}

}  // namespace penumbra
