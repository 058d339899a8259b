// Boxes around receivers that lie close together, so that a question is asked of all of them at once.
#pragma once

#include <cstdint>
#include <vector>

#include "render/receivers/receiver_groups.h"

namespace penumbra::detail {

struct ReceiverBox {
  Bounds points;
  /// The box of their normals. Empty where there are none.
  Bounds normals;
  /// How many are present.
  std::size_t count = 0;

  void add(const ReceiverBox& other);
};

/// Groups of receivers, and the box of each. Refers to nothing.
struct BoxedGroups {
  /// Cost O(receivers), on the calling arena's threads.
  explicit BoxedGroups(const Receivers& receivers);

  ReceiverGroups groups;
  std::vector<ReceiverBox> boxes;
};

}  // namespace penumbra::detail
