#include "apps/viewer/pictures/cut.h"

#include <glm/geometric.hpp>

namespace penumbra::viewer {

Cut cut_of(const State& state, const OverlayGeometry& g) {
  const Overlays& o = state.overlays;
  const bool cuts = o.cut < 1.0;
  if (o.cut_axis == CutAxis::kLight) {
    const Vec3 normal = light_frame(state.circular()).w;
    return {normal, glm::dot(g.start - g.origin, normal) + o.cut * g.reach, cuts};
  }
  Vec3 axis(0.0);
  axis[static_cast<int>(o.cut_axis) - static_cast<int>(CutAxis::kX)] = 1.0;
  return {axis, cuts ? (2.0 * o.cut - 1.0) * g.bound : 3e38, cuts};
}

}  // namespace penumbra::viewer
