// Receivers in boxes of neighbors, and boxes of boxes: so that a question is asked of all of them at once.
#pragma once

#include <cstdint>
#include <vector>

#include "render/receivers/receiver_box.h"

namespace penumbra::detail {

/// A tree with eight children a node over groups of up to 64 receivers. Refers to nothing.
class ReceiverBoxes {
 public:
  /// Cost O(receivers), on the calling arena's threads.
  explicit ReceiverBoxes(const Receivers& receivers);
  explicit ReceiverBoxes(const BoxedGroups& boxed);

  std::size_t present() const { return levels_.empty() ? 0 : levels_.back().front().count; }

  /// Groups of up to 64 receivers.
  std::size_t leaves() const { return order_.size(); }
  const ReceiverBox& leaf(std::size_t i) const { return levels_.front()[i]; }
  template <class Visit>
  void for_each_in_leaf(std::size_t i, const Visit& visit) const {
    groups_.for_each(order_[i], visit);
  }

  /// Goes down the tree. `passes(box)` tells whether all receivers of a box are done with; what does not pass
  /// is looked into. Calls `visit(index)` for each receiver that is left; true ends the walk. Returns whether
  /// one did. `receivers`: those of which this was made.
  template <class Passes, class Visit>
  bool find(const Receivers& receivers, const Passes& passes, const Visit& visit) const {
    return !levels_.empty() && find_below(receivers, levels_.size() - 1, 0, passes, visit);
  }

  /// How many receivers are in boxes that pass, groups being the smallest.
  template <class Passes>
  std::size_t count_passing(const Passes& passes) const {
    return levels_.empty() ? 0 : count_below(levels_.size() - 1, 0, passes);
  }

 private:
  static constexpr std::size_t kFanOut = 8;

  std::size_t end_of_children(std::size_t level, std::size_t node) const {
    return std::min((node + 1) * kFanOut, levels_[level - 1].size());
  }
  template <class Passes>
  std::size_t count_below(std::size_t level, std::size_t node, const Passes& passes) const;

  template <class Passes, class Visit>
  bool find_below(const Receivers& receivers, std::size_t level, std::size_t node, const Passes& passes,
                  const Visit& visit) const;

  ReceiverGroups groups_;
  std::vector<std::uint32_t> order_;              ///< groups as the leaves have them
  std::vector<std::vector<ReceiverBox>> levels_;  ///< from the leaves up; the last has one box
};

template <class Passes, class Visit>
bool ReceiverBoxes::find_below(const Receivers& receivers, std::size_t level, std::size_t node,
                               const Passes& passes, const Visit& visit) const {
  const ReceiverBox& box = levels_[level][node];
  if (box.count == 0 || passes(box)) return false;
  if (level == 0) {
    bool found = false;
    groups_.for_each(order_[node], [&](std::uint32_t index) {
      found = found || (receivers.is_present(index) && visit(index));
    });
    return found;
  }
  for (std::size_t child = node * kFanOut; child < end_of_children(level, node); ++child)
    if (find_below(receivers, level - 1, child, passes, visit)) return true;
  return false;
}

template <class Passes>
std::size_t ReceiverBoxes::count_below(std::size_t level, std::size_t node, const Passes& passes) const {
  const ReceiverBox& box = levels_[level][node];
  if (box.count == 0) return 0;
  if (passes(box)) return box.count;
  std::size_t count = 0;
  if (level > 0)
    for (std::size_t child = node * kFanOut; child < end_of_children(level, node); ++child)
      count += count_below(level - 1, child, passes);
  return count;
}

}  // namespace penumbra::detail
