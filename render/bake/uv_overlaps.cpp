#include "render/bake/uv_overlaps.h"

#include <algorithm>
#include <numeric>

#include "render/bake/clip.h"

namespace penumbra::detail {
double common_area(const FaceUv& a, const FaceUv& b) {
  const double turn = doubled_area(b);
  ConvexPolygon common(a);
  for (std::size_t i = 0; i < 3 && !common.empty(); ++i) {
    const glm::dvec2 from = b[i], along = b[(i + 1) % 3] - from;
    common = common.cut([&](const glm::dvec2& p) {
      const double side = cross(along, p - from);
      return turn < 0.0 ? -side : side;
    });
  }
  return common.measure().area;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> find_overlaps(std::span<const FaceUv> triangles,
                                                                   double least, std::size_t most) {
  std::vector<UvBox> boxes(triangles.begin(), triangles.end());
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t i, std::uint32_t j) {
    return boxes[i].low.x != boxes[j].low.x ? boxes[i].low.x < boxes[j].low.x : i < j;
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<std::uint32_t> open;  // those that a line of constant x meets
  for (const std::uint32_t i : order) {
    std::erase_if(open, [&](std::uint32_t j) { return boxes[j].high.x <= boxes[i].low.x; });
    for (const std::uint32_t j : open) {
      if (boxes[j].high.y <= boxes[i].low.y || boxes[i].high.y <= boxes[j].low.y) continue;
      if (!(common_area(triangles[i], triangles[j]) > least)) continue;
      pairs.push_back(std::minmax(i, j));
      if (pairs.size() == most) break;
    }
    if (pairs.size() == most) break;
    open.push_back(i);
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace penumbra::detail
