#include "render/center_view/map_receivers.h"

#include <algorithm>
#include <cmath>

#include "render/light/light_integrals.h"

namespace penumbra::detail {

std::optional<MapReceiver> to_map(const LightProjection& projection, const Receivers& receivers,
                                  std::size_t i) {
  const Vec3 local = projection.local(receivers.points[i]);
  const double weight = projection.weight(local);
  if (!(weight > 0.0)) return std::nullopt;
  MapReceiver out{projection.place(local) / weight, -local.z / weight};
  if (!receivers.has_normals()) return out;
  const Vec3 plane = projection.plane(receivers.normals[i], receivers.points[i]);
  const double steep = std::hypot(plane.x, plane.y);
  if (std::abs(plane.z) * kSteepest > steep)
    out.rise = -glm::dvec2(plane.x, plane.y) / plane.z;
  else if (steep > 0.0)
    out.rise = (plane.z > 0.0 ? -kSteepest : kSteepest) / steep * glm::dvec2(plane.x, plane.y);
  return out;
}

MapWindow seen_window(const LightProjection& projection, const Receivers& receivers, double top) {
  MapWindow out;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (!receivers.is_present(i)) continue;
    const auto at = to_map(projection, receivers, i);
    if (!at || !(top > at->height)) continue;
    const glm::dvec2 reach = projection.spread() * (top - at->height);
    out.add(at->place - reach);
    out.add(at->place + reach);
  }
  return out;
}

MapWindow looked_at(const CasterReach& casters, const LightProjection& projection,
                    const Receivers& receivers) {
  if (casters.window.empty()) return {};
  const MapWindow seen = seen_window(projection, receivers, casters.top);
  return {{std::max(casters.window.low.x, seen.low.x), std::max(casters.window.low.y, seen.low.y)},
          {std::min(casters.window.high.x, seen.high.x), std::min(casters.window.high.y, seen.high.y)}};
}

double above_horizon(const AreaLight& light, const Receivers& receivers, std::size_t i) {
  if (!receivers.has_normals()) return light.is_behind(receivers.points[i]) ? 0.0 : 1.0;
  return fraction_above_horizon(light, receivers.points[i], receivers.normals[i]);
}

}  // namespace penumbra::detail
