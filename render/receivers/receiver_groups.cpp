#include "render/receivers/receiver_groups.h"

#include <array>

#include "penumbra/mesh/triangle_mesh.h"
#include "render/support/kd_order.h"

namespace penumbra::detail {
namespace {

// Speed: so far apart, in halves of all receivers' extent, are two opposite normals. Receivers of a group
// then share their horizon as well as their place.
constexpr double kNormalWeight = 0.25;

struct Placed {
  std::array<double, 6> at;  ///< place, then normal
  std::uint32_t index;
};

}  // namespace

ReceiverGroups::ReceiverGroups(const Receivers& receivers)
    : width_(receivers.width), height_(receivers.height) {
  if (receivers.are_pixels()) {
    columns_ = (width_ + kTile - 1) / kTile;
    count_ = static_cast<std::size_t>(columns_) * static_cast<std::size_t>((height_ + kTile - 1) / kTile);
    return;
  }
  const Bounds bounds = bounds_of_present(receivers);
  const double scale = bounds.radius() > 0.0 ? 1.0 / bounds.radius() : 1.0;
  const Vec3 middle = bounds.empty() ? Vec3(0.0) : bounds.center();
  std::vector<Placed> placed(receivers.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Vec3 p = (receivers.is_present(i) ? receivers.points[i] : middle) * scale;
    const Vec3 n = receivers.has_normals() ? kNormalWeight * receivers.normals[i] : Vec3(0.0);
    placed[i] = {{p.x, p.y, p.z, n.x, n.y, n.z}, static_cast<std::uint32_t>(i)};
  }
  order_by_place<ByNumberThenAll>(placed.data(), placed.data() + placed.size(), kMost);
  for (std::size_t first = 0; first < placed.size(); first += kMost) {
    const auto begin = placed.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, begin + static_cast<std::ptrdiff_t>(std::min(kMost, placed.size() - first)),
              [](const Placed& p, const Placed& q) { return p.at < q.at; });
  }
  order_.reserve(placed.size());
  for (const Placed& p : placed) order_.push_back(p.index);
  count_ = (placed.size() + kMost - 1) / kMost;
}

}  // namespace penumbra::detail
