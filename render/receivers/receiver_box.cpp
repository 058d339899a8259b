#include "render/receivers/receiver_box.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace penumbra::detail {
namespace {

constexpr std::size_t kGroupsPerTask = 32;

ReceiverBox box_of(const Receivers& receivers, const ReceiverGroups& groups, std::size_t group) {
  ReceiverBox box;
  groups.for_each(group, [&](std::uint32_t index) {
    if (!receivers.is_present(index)) return;
    box.points.add(receivers.points[index]);
    if (receivers.has_normals()) box.normals.add(receivers.normals[index]);
    ++box.count;
  });
  return box;
}

}  // namespace

void ReceiverBox::add(const ReceiverBox& other) {
  if (other.count == 0) return;
  points.add(other.points);
  if (!other.normals.empty()) normals.add(other.normals);
  count += other.count;
}

BoxedGroups::BoxedGroups(const Receivers& receivers) : groups(receivers), boxes(groups.count()) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), kGroupsPerTask), [&](const auto& range) {
    for (std::size_t g = range.begin(); g < range.end(); ++g) boxes[g] = box_of(receivers, groups, g);
  });
}

}  // namespace penumbra::detail
