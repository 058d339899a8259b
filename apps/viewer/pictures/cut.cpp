#include "apps/viewer/pictures/cut.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace penumbra::viewer {
namespace {

constexpr double kReach = 4.0;  // radii of the casters on both sides of their middle

}  // namespace

Cut cut_of(const State& state, const OverlayGeometry& g) {
  const Overlays& o = state.overlays;
  const bool cuts = o.cut < 1.0;
  if (o.cut_axis == CutAxis::kLight) {
    const Vec3 normal = light_frame(state.circular()).w;
    return {normal, glm::dot(g.start - g.origin, normal) + o.cut * g.reach, cuts};
  }
  Vec3 axis(0.0);
  axis[static_cast<int>(o.cut_axis) - static_cast<int>(CutAxis::kX)] = 1.0;
  const double middle = glm::dot(state.casters.center() - g.origin, axis);
  const double reach = std::min(g.bound, kReach * state.casters.radius());
  return {axis, cuts ? middle + (2.0 * o.cut - 1.0) * reach : 3e38, cuts};
}

}  // namespace penumbra::viewer
