#include "render/plan/receiver_boxes.h"

#include <tbb/parallel_for.h>

#include <array>

#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

/// A group by the middle of its box; groups without receivers come anywhere.
struct PlacedGroup {
  std::array<double, 3> at{};
  std::uint32_t group = 0;
};

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

ReceiverBoxes::ReceiverBoxes(const Receivers& receivers) : groups_(receivers) {
  std::vector<PlacedGroup> placed(groups_.count());
  if (placed.empty()) return;
  std::vector<ReceiverBox> boxes(placed.size());
  tbb::parallel_for(std::size_t{0}, placed.size(), [&](std::size_t i) {
    placed[i].group = static_cast<std::uint32_t>(i);
    boxes[i] = box_of(receivers, groups_, i);
    if (boxes[i].count == 0) return;
    const Vec3 middle = boxes[i].points.center();
    placed[i].at = {middle.x, middle.y, middle.z};
  });
  order_by_place<ByNumberThenAll>(placed.data(), placed.data() + placed.size(), kFanOut);
  std::vector<ReceiverBox> leaves;
  leaves.reserve(placed.size());
  order_.reserve(placed.size());
  for (const PlacedGroup& each : placed) {
    order_.push_back(each.group);
    leaves.push_back(boxes[each.group]);
  }
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > 1) {
    std::vector<ReceiverBox> above((levels_.back().size() + kFanOut - 1) / kFanOut);
    for (std::size_t i = 0; i < levels_.back().size(); ++i) above[i / kFanOut].add(levels_.back()[i]);
    levels_.push_back(std::move(above));
  }
}

}  // namespace penumbra::detail
