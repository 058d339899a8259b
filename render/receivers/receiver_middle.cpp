#include "render/receivers/receiver_middle.h"

#include <algorithm>
#include <vector>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

/// Speed: receivers that are looked at, about.
constexpr std::size_t kSamples = 1'000;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ReceiverMiddle receiver_middle(const Receivers& receivers) {
  std::vector<Vec3> points;
  const std::size_t step = receivers.size() / kSamples | 1;  // odd: not a column of the image
  for (std::size_t i = 0; i < receivers.size(); i += step)
    if (receivers.is_present(i)) points.push_back(receivers.points[i]);
  for (std::size_t i = 0; i < receivers.size() && points.empty(); ++i)  // there may be few
    if (receivers.is_present(i)) points.push_back(receivers.points[i]);
  ReceiverMiddle out;
  if (points.empty()) return out;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(points, values.begin(), [&](const Vec3& p) { return p[axis]; });
    out.middle[axis] = median(values);
  }
  std::ranges::transform(points, values.begin(),
                         [&](const Vec3& p) { return largest_component(p - out.middle); });
  out.reach = median(values);
  return out;
}

}  // namespace penumbra::detail
