// Receivers in groups of up to 64 that lie close together, so that what one group needs is found once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "penumbra/render/receivers/receivers.h"

namespace penumbra::detail {

/// A picture's pixels in tiles of 8×8. Other receivers by place and normal, in an order that does not depend
/// on the one in which they are given. Refers to nothing.
class ReceiverGroups {
 public:
  static constexpr int kTile = 8;  ///< pixels a side
  static constexpr std::size_t kMost = kTile * kTile;

  /// Cost O(1) for pixels, O(n log n) for n other receivers, on the calling arena's threads.
  explicit ReceiverGroups(const Receivers& receivers);

  std::size_t count() const { return count_; }
  /// Calls `visit(index)` for the receivers of a group, in an order that is always the same.
  template <class Visit>
  void for_each(std::size_t group, const Visit& visit) const {
    if (width_ == 0) {
      const std::size_t first = group * kMost, last = std::min(first + kMost, order_.size());
      for (std::size_t i = first; i < last; ++i) visit(order_[i]);
      return;
    }
    const int left = static_cast<int>(group) % columns_ * kTile,
              top = static_cast<int>(group) / columns_ * kTile;
    for (int y = top; y < std::min(top + kTile, height_); ++y)
      for (int x = left; x < std::min(left + kTile, width_); ++x)
        visit(static_cast<std::uint32_t>(y * width_ + x));
  }

 private:
  int width_ = 0, height_ = 0, columns_ = 0;
  std::size_t count_ = 0;
  std::vector<std::uint32_t> order_;  ///< of receivers that are no pixels
};

}  // namespace penumbra::detail
