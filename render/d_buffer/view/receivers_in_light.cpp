#include "render/d_buffer/view/receivers_in_light.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace penumbra::detail {
namespace {

/// Speed: receivers that share a box.
constexpr std::size_t kPerBox = 64;
constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

}  // namespace

ReceiversInLight::ReceiversInLight(const Receivers& receivers, const LightSpace& space)
    : receivers_(receivers), places_(receivers.size()), boxes_((receivers.size() + kPerBox - 1) / kPerBox) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes_.size(), 32), [&](const auto& boxes) {
    for (std::size_t b = boxes.begin(); b < boxes.end(); ++b) {
      Box& box = boxes_[b];
      box.low = std::numeric_limits<double>::infinity();
      for (std::size_t i = b * kPerBox; i < std::min((b + 1) * kPerBox, places_.size()); ++i) {
        places_[i].h = kNowhere;
        if (!receivers.is_present(i)) continue;
        const glm::dvec4 p = space.homogeneous(receivers.points[i]);
        if (!(p.w > 0.0)) continue;
        places_[i] = divided(p);
        box.uv.add(places_[i].uv);
        box.low = std::min(box.low, places_[i].h);
      }
    }
  });
}

UvBounds ReceiversInLight::bounds() const {
  UvBounds out;
  for (const Box& box : boxes_) out.add(box.uv);
  return out;
}

double ReceiversInLight::lowest(const UvBounds& window) const {
  double low = std::numeric_limits<double>::infinity();
  for (const Box& box : boxes_)
    if (!common(box.uv, window).empty()) low = std::min(low, box.low);
  return low;
}

ReceiverTexels ReceiversInLight::texels(const LightSpace& windowed,
                                        std::span<const std::uint32_t> first_face) const {
  ReceiverTexels out{std::vector<glm::vec4>(places_.size()), std::vector<glm::vec4>(places_.size())};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places_.size(), 2048), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (!receivers_.is_present(i)) continue;
      const auto face = static_cast<float>(first_face[static_cast<std::size_t>(receivers_.objects[i])] +
                                           receivers_.faces[i] + 1);
      if (std::isnan(places_[i].h)) {
        out.positions[i] = {0.0f, 0.0f, 0.0f, -face};
        continue;
      }
      const Uvh at = windowed.in_window(places_[i]);
      out.positions[i] = {glm::vec2(at.uv), static_cast<float>(at.h), face};
      out.planes[i] = {glm::vec3(windowed.plane(receivers_.normals[i], receivers_.points[i])), 0.0f};
    }
  });
  return out;
}

}  // namespace penumbra::detail
