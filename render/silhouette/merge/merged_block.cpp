#include "render/silhouette/merge/merged_block.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace penumbra::detail {

void MergedBlock::make_boxes() {
  for (std::size_t k = 0; k < count; ++k) {
    MergedSides& s = sides[k];
    Bounds box{glm::min(edges[k].a, edges[k].b) - s.margin, glm::max(edges[k].a, edges[k].b) + s.margin};
    for (const MergedSides::Side& side : {s.left, s.right})
      if (!side.is_flat) box.add(Bounds{side.center - side.radius, side.center + side.radius});
    s.middle = box.center();
    s.half = (0.5 + 0x1p-50) * (box.high - box.low);
  }
}

BlockBounds MergedBlock::bounds() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds box, normals;
  for (std::size_t k = 0; k < count; ++k)
    box.add(Bounds{sides[k].middle - sides[k].half, sides[k].middle + sides[k].half});

  BlockBounds out{box.low, box.high, Vec3(0.0), Vec3(0.0), kInfinity, -kInfinity};
  const Vec3 middle = box.center();
  const auto add = [&](const FacePlane& plane, const MergedSides::Side& s) {
    if (plane.tolerance < 0.0) {  // no face: the edge has no side
      out.near_low = -kInfinity, out.near_high = kInfinity;
      return;
    }
    normals.add(plane.normal - s.tilt);
    normals.add(plane.normal + s.tilt);
    const double v = plane.value(middle);
    const double off = plane.tolerance + s.reach(middle);
    out.near_low = std::min(out.near_low, v - off);
    out.near_high = std::max(out.near_high, v + off);
  };
  for (std::size_t k = 0; k < count; ++k) {
    add(edges[k].left, sides[k].left);
    add(edges[k].right, sides[k].right);
  }
  out.normal_low = normals.low, out.normal_high = normals.high;
  return out;
}

}  // namespace penumbra::detail
