#include "render/silhouette/edges/unit_light.h"

namespace penumbra::detail {
namespace {

/// Turned about w by a little more than half a radian. The slope is the golden section: it is far from the
/// slopes of regular patterns.
LightFrame turned(const LightFrame& axes) {
  constexpr double kCosine = 0.85065080835203993, kSine = 0.52573111211913361;
  return {kCosine * axes.u + kSine * axes.v, kCosine * axes.v - kSine * axes.u, axes.w};
}

}  // namespace

UnitLight::UnitLight(const DiskLight& light)
    : disk_(light),
      axes_(turned(light_frame(light))),
      center_(light.center),
      across_(light.radius * axes_.u),
      up_(light.radius * axes_.v),
      per_radius_(1.0 / light.radius) {}

}  // namespace penumbra::detail
