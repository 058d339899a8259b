#include "volumes/solids/simplify/disjoint_boxes.h"

#include <algorithm>
#include <limits>

namespace penumbra::detail {

DisjointBoxes::DisjointBoxes(std::span<const Vec3> positions, std::vector<std::uint32_t> points,
                             std::size_t most, double share)
    : positions_(positions), most_(most), share_(share), points_(std::move(points)) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  divide(0, points_.size(), {Vec3(-kFar), Vec3(kFar)});
  first_.push_back(points_.size());
}

void DisjointBoxes::divide(std::size_t first, std::size_t last, const Bounds& box) {
  Bounds used;
  for (std::size_t i = first; i < last; ++i) used.add(positions_[points_[i]]);
  const Vec3 size = used.high - used.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
  if (last - first > most_) {
    const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(first),
               end = points_.begin() + static_cast<std::ptrdiff_t>(last);
    const auto middle = begin + static_cast<std::ptrdiff_t>(share_ * static_cast<double>(last - first));
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
      return positions_[a][axis] < positions_[b][axis];
    });
    const double cut = positions_[*middle][axis];
    const auto above = std::partition(begin, end, [&](std::uint32_t v) { return positions_[v][axis] < cut; });
    if (above != begin) {  // else all are at one height, or most at the lowest
      Bounds low = box, high = box;
      low.high[axis] = high.low[axis] = cut;
      const auto at = static_cast<std::size_t>(above - points_.begin());
      divide(first, at, low);
      return divide(at, last, high);
    }
  }
  std::sort(points_.begin() + static_cast<std::ptrdiff_t>(first),
            points_.begin() + static_cast<std::ptrdiff_t>(last));
  boxes_.push_back(box);
  first_.push_back(first);
}

}  // namespace penumbra::detail
