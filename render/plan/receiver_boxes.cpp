#include "render/plan/receiver_boxes.h"

#include <array>

#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

/// A group by the middle of its box; groups without receivers come anywhere.
struct PlacedGroup {
  std::array<double, 3> at{};
  std::uint32_t group = 0;
};

}  // namespace

ReceiverBoxes::ReceiverBoxes(const Receivers& receivers) : ReceiverBoxes(BoxedGroups(receivers)) {}

ReceiverBoxes::ReceiverBoxes(const BoxedGroups& boxed) : groups_(boxed.groups) {
  const std::vector<ReceiverBox>& boxes = boxed.boxes;
  std::vector<PlacedGroup> placed(boxes.size());
  if (placed.empty()) return;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].group = static_cast<std::uint32_t>(i);
    if (boxes[i].count == 0) continue;
    const Vec3 middle = boxes[i].points.center();
    placed[i].at = {middle.x, middle.y, middle.z};
  }
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
