#include "render/receivers/receiver_box.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>

namespace penumbra::detail {
namespace {

constexpr std::size_t kGroupsPerTask = 32;

/// Bounds::add for very many points: this walk over all receivers is the most that a plan costs.
struct Extremes {
  Vec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  void add(const Vec3& p) {
    for (int k = 0; k < 3; ++k) {
      low[k] = p[k] < low[k] ? p[k] : low[k];
      high[k] = p[k] > high[k] ? p[k] : high[k];
    }
  }
  Bounds bounds() const {
    Bounds out;
    out.add(low);
    out.add(high);
    return out;
  }
};

ReceiverBox box_of(const Receivers& receivers, const ReceiverGroups& groups, std::size_t group) {
  Extremes points, normals;
  ReceiverBox box;
  const bool has_normals = receivers.has_normals();
  groups.for_each(group, [&](std::uint32_t index) {
    if (!receivers.is_present(index)) return;
    points.add(receivers.points[index]);
    if (has_normals) normals.add(receivers.normals[index]);
    ++box.count;
  });
  if (box.count == 0) return box;
  box.points = points.bounds();
  if (has_normals) box.normals = normals.bounds();
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
