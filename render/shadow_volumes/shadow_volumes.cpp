#include "render/shadow_volumes/shadow_volumes.h"

#include <algorithm>
#include <atomic>
#include <glm/geometric.hpp>
#include <optional>

#include "render/rays/each_receiver.h"
#include "render/shadow_volumes/culled_casters.h"
#include "render/shadow_volumes/volume_counter.h"

namespace penumbra {
namespace {

using namespace detail;

/// In front of the light, and with its center above the horizon.
bool looks_at_center(const AreaLight& light, const Receivers& receivers, std::size_t i, bool horizon) {
  const Vec3& x = receivers.points[i];
  return !light.is_behind(x) && (!horizon || glm::dot(receivers.normals[i], light.from_receiver(x)) > 0.0);
}

}  // namespace

ShadowVolumeResult shadow_volumes(const Scene& scene, const LightShape& shape, const Receivers& receivers,
                                  const ShadowVolumeOptions& options, tbb::task_arena& threads,
                                  const Progress& progress) {
  ShadowVolumeResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const AreaLight light = area_light(shape);
  std::vector<char> culled;
  if (options.cull)
    culled = threads.execute([&] { return casters_without_receivers(scene, light, BoxedGroups(receivers)); });
  const VolumePolygons polygons = volume_polygons(scene, shape, culled);
  std::optional<VolumeCounter> counter;
  threads.execute([&] { counter.emplace(polygons, light, receivers, CounterOptions{options.clamp}); });
  clock.finish("polygons");

  const bool horizon = options.horizon && receivers.has_normals();
  std::atomic<std::size_t> tested{0}, crossed{0};
  constexpr std::size_t kBlock = 256;
  for_each_block(threads, (receivers.size() + kBlock - 1) / kBlock, progress, [&](std::size_t b) {
    CrossingCounts counts;
    for (std::size_t i = b * kBlock; i < std::min(receivers.size(), (b + 1) * kBlock); ++i) {
      if (!receivers.is_present(i)) continue;
      const bool is_lit = looks_at_center(light, receivers, i, horizon) &&
                          counter->volumes_around(start_of(receivers, i), counts) <= 0;
      out.visibility[i] = is_lit ? 1.0f : 0.0f;
    }
    tested += counts.tested;
    crossed += counts.crossed;
  });
  clock.finish("receivers");
  out.stages = clock.stages();
  out.counts = {.casters = polygons.casters,
                .culled_casters = static_cast<std::size_t>(std::ranges::count(culled, char{1})),
                .caps = polygons.caps.size(),
                .sides = polygons.sides.size(),
                .reached_caps = counter->caps(),
                .reached_sides = counter->sides(),
                .tested = tested,
                .crossed = crossed};
  return out;
}

}  // namespace penumbra
