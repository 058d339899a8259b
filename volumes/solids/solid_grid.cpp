#include "volumes/solids/solid_grid.h"

#include <algorithm>
#include <cmath>

#include "penumbra/mesh/error.h"

namespace penumbra::detail {

SolidGrid::SolidGrid(const Bounds& box, double spacing) : box_(box) {
  double total = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double cells = std::ceil((box.high[k] - box.low[k]) / spacing);
    const double count = kBlock * std::ceil((cells + 1.0) / kBlock);
    total *= count;
    if (!(total < 0x1p31))
      throw UsageError(
          "a solid of this tolerance needs more than 2^31 grid points; give a larger tolerance or a "
          "smaller bound");
    counts_[k] = static_cast<std::int32_t>(count);
    blocks_[k] = counts_[k] / kBlock;
    step_[k] = (box.high[k] - box.low[k]) / (counts_[k] - 1);
  }
  inside_.assign(static_cast<std::size_t>(total), 0);
}

Vec3 SolidGrid::point(const GridIndex& at) const {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = at[k] + 1 == counts_[k] ? box_.high[k] : box_.low[k] + at[k] * step_[k];
  return p;
}

GridIndex SolidGrid::cube_of(const Vec3& p) const {
  GridIndex at;
  for (int k = 0; k < 3; ++k)
    at[k] =
        std::clamp(static_cast<std::int32_t>(std::floor((p[k] - box_.low[k]) / step_[k])), 0, counts_[k] - 2);
  return at;
}

}  // namespace penumbra::detail
