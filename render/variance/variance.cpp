#include "render/variance/variance.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/center_view/map_receivers.h"
#include "render/rays/each_receiver.h"
#include "render/receivers/receiver_middle.h"
#include "render/variance/moment_table.h"

namespace penumbra {
namespace {

using namespace detail;

/// Accuracy. Depths that are this close, of the whole range, are not told apart: a surface would shadow
/// itself.
constexpr double kSameDepth = 1e-4;
/// Accuracy. Where a larger share is not nearer than the receiver, there is no blocker.
constexpr double kNoBlocker = 1.0 - 1e-4;

class Lookup {
 public:
  Lookup(const LightProjection& projection, const AreaLight& light, const ShadowMap& map,
         const CasterReach& casters, double lowest, const VarianceOptions& options)
      : top_(casters.top),
        scale_(projection.nearness(), casters.top, std::min(lowest, casters.bottom)),
        table_(map, scale_, options.warp),
        half_(projection.spread() * (light.disk ? 0.5 * std::sqrt(std::numbers::pi) : 1.0)),
        least_(options.least_share) {}

  /// The share of the light that is not hidden.
  double visible(const MapReceiver& receiver) const {
    if (!(top_ > receiver.height)) return 1.0;
    const double depth = scale_.depth_of(receiver.height);
    const Moments search = table_.mean(receiver.place, half_ * (top_ - receiver.height));
    const double free = share_beyond(search, depth);
    if (free > kNoBlocker) return 1.0;
    const double blocker = std::clamp((search.depth - free * depth) / (1.0 - free), 0.0, depth);
    const double above = std::max(0.0, scale_.height_of(blocker) - receiver.height);
    const double share = share_beyond(table_.mean(receiver.place, half_ * above), depth);
    return std::max(0.0, (share - least_) / (1.0 - least_));
  }

 private:
  /// Chebyshev's bound on the share of a window whose values are not below one, by their mean and mean
  /// square. `grain`: values that are not told apart.
  static double bound(double value, double mean, double mean2, double grain) {
    const double past = value - mean;
    if (!(past > 0.0)) return 1.0;
    const double variance = std::max(grain * grain, mean2 - mean * mean);
    return variance / (variance + past * past);
  }
  /// The lesser bound on the share of a window that is not nearer to the light than a depth.
  double share_beyond(const Moments& of, double depth) const {
    const Warped at = table_.warped(depth), rise = table_.rise(depth);
    return std::min(bound(at.far, of.far, of.far2, kSameDepth * rise.far),
                    bound(at.near, of.near, of.near2, kSameDepth * rise.near));
  }

  const double top_;
  const DepthScale scale_;
  const MomentTable table_;
  /// Of the window at a height of 1 above the receiver.
  const glm::dvec2 half_;
  const double least_;
};

double lowest_of(const LightProjection& projection, const Receivers& receivers) {
  double lowest = 1e300;
  for (std::size_t i = 0; i < receivers.size(); ++i)
    if (receivers.is_present(i))
      if (const auto at = to_map(projection, receivers, i)) lowest = std::min(lowest, at->height);
  return lowest;
}

}  // namespace

MethodResult variance_visibility(const Scene& scene, const AreaLight& light, const Receivers& receivers,
                                 const VarianceOptions& options, bool keep_textures, tbb::task_arena& threads,
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
    clock.finish("shadow_map");
    lookup.emplace(projection, light, *map, casters, lowest_of(projection, receivers), options);
    if (keep_textures) out.textures.push_back(map->picture());
  }
  clock.finish("tables");
  std::atomic<std::size_t> looked{0};
  for_each_receiver(threads, receivers.size(), progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    double v = above_horizon(light, receivers, i);
    const auto at = v > 0.0 && lookup ? to_map(projection, receivers, i) : std::nullopt;
    if (at) {
      v *= lookup->visible(*at);
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
