#include "render/center_view/outer_window.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/receivers/receiver_middle.h"

namespace penumbra::detail {
namespace {

LightProjection projection_of(const AreaLight& light, const Receivers& receivers) {
  const ReceiverMiddle middle = receiver_middle(receivers);
  return {light, middle.middle, middle.least_depth()};
}

}  // namespace

OuterPenumbra::OuterPenumbra(const Scene& scene, const AreaLight& light, const Receivers& receivers)
    : projection(projection_of(light, receivers)) {
  const glm::dvec2 half = projection.spread();
  radius = light.disk ? half.x : std::sqrt(4.0 * half.x * half.y / std::numbers::pi);
  MapWindow seen;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (!receivers.is_present(i)) continue;
    const auto at = to_map(projection, receivers, i);
    if (!at) continue;
    lowest = std::min(lowest, at->height);
    seen.add(at->place);
  }
  const CasterReach casters = reach_of_casters(scene, projection);
  top = casters.top;
  if (casters.window.empty() || !(casters.top > lowest)) return;
  // Wider than receivers, which may lie in a line.
  const double reach = radius * (casters.top - lowest);
  for (int k = 0; k < 2; ++k) {
    window.low[k] = std::max(casters.window.low[k] - reach, seen.low[k] - reach);
    window.high[k] = std::min(casters.window.high[k] + reach, seen.high[k] + reach);
  }
}

bool is_hidden(const ShadowMap& casters, const MapReceiver& receiver, const MapBias& bias) {
  const double slope = std::min(kSteepest, std::hypot(receiver.rise.x, receiver.rise.y));
  return casters.height(receiver.place) >
         receiver.height + casters.texel() * (bias.constant + bias.slope * slope);
}

}  // namespace penumbra::detail
