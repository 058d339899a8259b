// Sets of indices that are joined step by step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace penumbra::detail {

/// Each set is named by its lowest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }
  /// For each index its set.
  std::vector<std::uint32_t> all() && {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = find(i);
    return std::move(parent_);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace penumbra::detail
