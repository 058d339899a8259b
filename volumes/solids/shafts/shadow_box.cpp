#include "volumes/solids/shafts/shadow_box.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace penumbra::detail {

LitBoxes::LitBoxes(const CasterTree& tree, const CircularLight& light, const Bounds& bound)
    : tree_(tree), light_(light), frame_(light_frame(light)), bound_(bound) {
  Bounds all = bound;
  all.add(tree.bounds());
  extent_ = 2.0 * all.radius();
}

bool LitBoxes::is_lit(const Bounds& box) const {
  std::array<Vec3, 8> corners;
  int in_front = 0;
  for (int i = 0; i < 8; ++i) {
    corners[i] = {i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                  i & 4 ? box.high.z : box.low.z};
    in_front += is_behind(light_, corners[i]) ? 0 : 1;
  }
  if (in_front < 8) return in_front == 0;
  std::uint32_t likely = CasterTree::kNoFace;
  return tree_.is_clear(LightShaft(light_, frame_, corners, extent_), likely);
}

Bounds LitBoxes::shadow_box(int depth) const {
  Bounds out;
  visit(bound_, depth, out);
  return out;
}

void LitBoxes::visit(const Bounds& box, int depth, Bounds& out) const {
  const bool known = !out.empty() && box.low.x >= out.low.x && box.low.y >= out.low.y &&
                     box.low.z >= out.low.z && box.high.x <= out.high.x && box.high.y <= out.high.y &&
                     box.high.z <= out.high.z;
  if (known || is_lit(box)) return;
  if (depth == 0) return out.add(box);
  const Vec3 middle = box.center();
  for (int i = 0; i < 8; ++i) {
    Bounds part;
    for (int k = 0; k < 3; ++k) {
      part.low[k] = i >> k & 1 ? middle[k] : box.low[k];
      part.high[k] = i >> k & 1 ? box.high[k] : middle[k];
    }
    visit(part, depth - 1, out);
  }
}

}  // namespace penumbra::detail
