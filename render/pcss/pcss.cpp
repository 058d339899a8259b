#include "render/pcss/pcss.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "render/center_view/map_receivers.h"
#include "render/light/light_samples.h"
#include "render/rays/each_receiver.h"
#include "render/receivers/receiver_middle.h"
#include "render/receivers/sample_key.h"

namespace penumbra {
namespace {

using namespace detail;

class Lookup {
 public:
  Lookup(const LightProjection& projection, const AreaLight& light, const ShadowMap& map, double top,
         const PcssOptions& options)
      : projection_(projection),
        map_(map),
        top_(top),
        disk_(light.disk),
        options_(options),
        search_(options.search_samples),
        filter_(options.filter_samples) {}

  /// The share of the light that is not hidden.
  double visible(const MapReceiver& receiver, std::uint32_t key) const {
    const Found search = look(receiver, search_, key, top_ - receiver.height);
    if (search.blockers == 0) return 1.0;
    const double depth = search.depths / search.blockers;
    const double blocker = -depth / (1.0 + projection_.nearness() * depth);
    const Found filter = look(receiver, filter_, mix(key), blocker - receiver.height);
    return 1.0 - static_cast<double>(filter.blockers) / filter_.strata.count();
  }

 private:
  struct Found {
    int blockers = 0;
    /// Sum over the blockers: how far away from the light they lie behind the map's origin.
    double depths = 0.0;
  };

  /// The samples of the window that the light covers at a height above the receiver.
  Found look(const MapReceiver& receiver, const StratumTable& table, std::uint32_t key, double above) const {
    Found out;
    if (!(above > 0.0)) return out;
    const glm::dvec2 reach = projection_.spread() * above;
    const double slope = std::min(kSteepest, std::hypot(receiver.rise.x, receiver.rise.y));
    const double bias = map_.texel() * (options_.bias.constant + options_.bias.slope * slope);
    std::array<float, kSampleLanes> a, b;
    for (int first = 0; first < table.strata.count(); first += kSampleLanes) {
      place_samples(table, disk_, key, first, a.data(), b.data());
      const int count = std::min(kSampleLanes, table.strata.count() - first);
      for (int k = 0; k < count; ++k) {
        const glm::dvec2 off(reach.x * a[static_cast<std::size_t>(k)],
                             reach.y * b[static_cast<std::size_t>(k)]);
        const double height = map_.height(receiver.place + off);
        double own = receiver.height + bias;
        if (options_.receiver_plane) own += receiver.rise.x * off.x + receiver.rise.y * off.y;
        if (!(height > own)) continue;
        ++out.blockers;
        out.depths -= height / (1.0 + projection_.nearness() * height);
      }
    }
    return out;
  }

  const LightProjection& projection_;
  const ShadowMap& map_;
  const double top_;
  const bool disk_;
  const PcssOptions& options_;
  const StratumTable search_, filter_;
};

}  // namespace

MethodResult pcss_visibility(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                             const PcssOptions& options, bool keep_textures, tbb::task_arena& threads,
                             const Progress& progress) {
  MethodResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  StageClock clock;
  const ReceiverMiddle middle = receiver_middle(receivers);
  const LightProjection projection(light, middle.middle, middle.least_depth());
  const CasterReach casters = reach_of_casters(scene, projection);
  const MapWindow window = looked_at(casters, projection, receivers);
  std::optional<ShadowMap> map;
  std::optional<Lookup> lookup;
  if (!window.empty()) {
    map.emplace(scene, projection, window, options.map_size, threads);
    lookup.emplace(projection, light, *map, casters.top, options);
    if (keep_textures) out.textures.push_back(map->picture());
  }
  clock.finish("shadow_map");
  std::atomic<std::size_t> looked{0};
  for_each_receiver(threads, receivers.size(), progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    double v = above_horizon(light, receivers, i);
    const auto at = v > 0.0 && lookup ? to_map(projection, receivers, i) : std::nullopt;
    if (at) {
      v *= lookup->visible(*at, sample_key_of(receivers, static_cast<std::uint32_t>(i), 1));
      looked.fetch_add(1, std::memory_order_relaxed);
    }
    out.visibility[i] = static_cast<float>(v);
  });
  clock.finish("visibility");
  out.stages = clock.stages();
  out.counts = {{"receivers", looked.load()}, {"map_texels", map ? map->texels() : std::size_t{0}}};
  return out;
}

}  // namespace penumbra
