#include "render/scene/ray_frame.h"

#include <algorithm>
#include <cmath>

namespace penumbra {

RayFrame frame_around(const Bounds& bounds) {
  constexpr double kLargestExponent = 1000.0;  // of a scale that does not overflow
  if (bounds.empty()) return {};
  const Vec3 half = 0.5 * bounds.high - 0.5 * bounds.low;
  const double reach = std::max({half.x, half.y, half.z});
  const double exponent = reach > 0.0 ? -std::ceil(std::log2(reach)) : 0.0;
  return {bounds.center(), std::exp2(std::min(exponent, kLargestExponent))};
}

RayFrame ray_frame(const Scene& scene) {
  const Bounds casters = scene.caster_bounds();
  return casters.empty() ? frame_of_all_objects(scene) : frame_around(casters);
}

RayFrame frame_of_all_objects(const Scene& scene) {
  return frame_around(scene.bounds());
}

}  // namespace penumbra
