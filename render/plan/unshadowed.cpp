#include "render/plan/unshadowed.h"

#include <utility>

#include "render/light/light_integrals.h"
#include "render/rays/each_receiver.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

MethodResult see_unshadowed(const MethodInput& input) {
  const AreaLight light = area_light(input.light);
  const Receivers& receivers = input.receivers;
  MethodResult out;
  out.visibility.assign(receivers.size(), 1.0f);
  out.region.assign(receivers.size(), -1);
  if (input.with_unoccluded) out.unoccluded.assign(receivers.size(), 1.0f);
  for_each_receiver(input.rays.arena(), receivers.size(), input.progress, [&](std::size_t i) {
    if (!receivers.is_present(i)) return;
    const Vec3& x = receivers.points[i];
    const bool behind = light.is_behind(x);
    double above = behind ? 0.0 : 1.0;
    if (!behind && receivers.has_normals()) above = fraction_above_horizon(light, x, receivers.normals[i]);
    out.visibility[i] = static_cast<float>(above);
    if (behind)
      out.region[i] = 2;
    else if (above > 0.0)
      out.region[i] = 0;
    if (input.with_unoccluded) out.unoccluded[i] = behind ? 0.0f : 1.0f;
  });
  return out;
}

void fill_dark(const MethodInput& input, MethodResult& result) {
  if (!result.is_dark || !result.visibility.empty()) return;
  MethodResult seen = see_unshadowed(input);
  result.visibility = std::move(seen.visibility);
  result.unoccluded = std::move(seen.unoccluded);
  result.region = std::move(seen.region);
}

}  // namespace penumbra::detail
