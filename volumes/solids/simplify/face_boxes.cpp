#include "volumes/solids/simplify/face_boxes.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace penumbra::detail {

FaceBoxes::FaceBoxes(std::vector<Bounds> boxes)
    : leaves_(std::bit_ceil(static_cast<std::uint32_t>(std::max<std::size_t>(boxes.size(), 1)))),
      nodes_(2 * static_cast<std::size_t>(leaves_)),
      faces_(boxes.size()),
      leaf_of_(boxes.size()) {
  std::iota(faces_.begin(), faces_.end(), 0u);
  std::vector<Vec3> middles(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) middles[i] = boxes[i].center();
  order(faces_, middles, leaves_);
  for (std::uint32_t i = 0; i < faces_.size(); ++i) {
    leaf_of_[faces_[i]] = i;
    nodes_[leaves_ + i] = boxes[faces_[i]];
  }
  for (std::uint32_t at = leaves_ - 1; at >= 1; --at) {
    nodes_[at] = nodes_[2 * at];
    nodes_[at].add(nodes_[2 * at + 1]);
  }
}

/// Halves that lie apart, so that the first `leaves / 2` are below one node.
void FaceBoxes::order(std::span<std::uint32_t> part, std::span<const Vec3> middles, std::uint32_t leaves) {
  if (part.size() <= 2 || leaves <= 1) return;
  Bounds box;
  for (const std::uint32_t f : part) box.add(middles[f]);
  const Vec3 size = box.high - box.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  const std::size_t middle = leaves / 2;
  if (part.size() <= middle) return order(part, middles, leaves / 2);
  std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(middles[a][axis], a) < std::pair(middles[b][axis], b);
                   });
  order(part.first(middle), middles, leaves / 2);
  order(part.subspan(middle), middles, leaves / 2);
}

void FaceBoxes::set(std::uint32_t face, const Bounds& box) {
  std::uint32_t at = leaves_ + leaf_of_[face];
  nodes_[at] = box;
  for (at /= 2; at >= 1; at /= 2) {
    Bounds both = nodes_[2 * at];
    both.add(nodes_[2 * at + 1]);
    if (both.low == nodes_[at].low && both.high == nodes_[at].high) return;
    nodes_[at] = both;
  }
}

}  // namespace penumbra::detail
