// Puts what lies close together next to each other: halves across the longest side, over and over.
#pragma once

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace penumbra::detail {

/// Compares items by one of their numbers. Items that tie keep no particular order.
struct ByNumber {
  std::size_t axis;
  template <class Item>
  bool operator()(const Item& p, const Item& q) const {
    return p.at[axis] < q.at[axis];
  }
};

/// Compares items by one of their numbers, those that tie by all of them: which items come to lie in a group
/// then does not depend on the order in which they are given.
struct ByNumberThenAll {
  std::size_t axis;
  template <class Item>
  bool operator()(const Item& p, const Item& q) const {
    return p.at[axis] != q.at[axis] ? p.at[axis] < q.at[axis] : p.at < q.at;
  }
};

/// Orders [first, last) so that every group of `leaf` items in a row lies close together, and so does every
/// group of 2, 4, 8... such groups: as many groups go to the first half as the greatest power of two says.
/// Item::at is an array of numbers, of any length. Cost O(n log n), on all cores; deterministic.
template <class Less = ByNumber, class Item>
void order_by_place(Item* first, Item* last, std::size_t leaf) {
  const auto groups = (static_cast<std::size_t>(last - first) + leaf - 1) / leaf;
  if (groups < 2) return;
  auto low = first->at, high = first->at;
  for (const Item* p = first; p != last; ++p)
    for (std::size_t k = 0; k < low.size(); ++k) {
      low[k] = std::min(low[k], p->at[k]);
      high[k] = std::max(high[k], p->at[k]);
    }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < low.size(); ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  Item* middle = first + std::bit_floor(groups - 1) * leaf;
  std::nth_element(first, middle, last, Less{axis});
  constexpr std::size_t kItemsPerTask = 512;
  if (static_cast<std::size_t>(last - first) < kItemsPerTask) {
    order_by_place<Less>(first, middle, leaf);
    order_by_place<Less>(middle, last, leaf);
  } else {
    tbb::parallel_invoke([=] { order_by_place<Less>(first, middle, leaf); },
                         [=] { order_by_place<Less>(middle, last, leaf); });
  }
}

}  // namespace penumbra::detail
