#include "render/plan/light_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra::detail {
namespace {

/// Relative to the sizes of what is summed. Roundings are some 2^-50 of these.
constexpr double kFarAboveRounding = 0x1p-36;
/// Receivers that are nearer to the light's plane, relative to their distance from its center, are not looked
/// at: their depth would have lost ten bits, and the slopes of the sides with it.
constexpr double kLeastDepth = 0x1p-10;

double largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Half the extent of a box along n.
double extent(const Vec3& n, const Vec3& half) {
  return std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
}

/// The largest N·q for N and q in two boxes.
double largest_product(const Bounds& a, const Vec3& low, const Vec3& high) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
    sum += std::max({a.low[k] * low[k], a.low[k] * high[k], a.high[k] * low[k], a.high[k] * high[k]});
  return sum;
}

}  // namespace

LightSides::LightSides(const CircularLight& light)
    : distant_(light.is_distant()), origin_(distant_ ? Vec3(0.0) : light.center), radius_(light.radius) {
  const LightFrame frame = light_frame(light);
  normal_ = frame.w;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kSides;
    sides_[static_cast<std::size_t>(k)] = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
  }
}

LightSides::Box LightSides::box_of(const Bounds& bounds) const {
  const Vec3 low = bounds.low - origin_, high = bounds.high - origin_;
  return {0.5 * (low + high), 0.5 * (high - low), std::max(largest(low), largest(high))};
}

bool LightSides::is_behind(const Bounds& bounds) const {
  if (distant_) return false;
  const Box box = box_of(bounds);
  return glm::dot(normal_, box.middle) + extent(normal_, box.half) <= -kFarAboveRounding * box.reach;
}

bool LightSides::is_dark(const ReceiverBox& box, bool horizon) const {
  if (is_behind(box.points)) return true;
  if (!horizon || box.normals.empty()) return false;
  if (distant_) return largest_product(box.normals, -normal_, -normal_) + radius_ < -kFarAboveRounding;
  const Vec3 low = origin_ - box.points.high, high = origin_ - box.points.low;
  const double size = 3.0 * std::max(largest(low), largest(high)) + radius_;
  return largest_product(box.normals, low, high) + radius_ < -kFarAboveRounding * size;
}

bool LightSides::separates(const Bounds& receivers, const Bounds& caster) const {
  const Box r = box_of(receivers), b = box_of(caster);
  const double middle = glm::dot(normal_, r.middle), half = extent(normal_, r.half);
  const double near = middle - half, far = middle + half;
  if (!distant_ && !(near > kLeastDepth * (r.reach + radius_))) return false;
  if (glm::dot(normal_, b.middle) - extent(normal_, b.half) > far + kFarAboveRounding * (b.reach + r.reach))
    return true;
  for (const Vec3& d : sides_)
    if (separates_by_side(d, r, near, far, b)) return true;
  return separates_by_axis(0, r, b) || separates_by_axis(1, r, b) || separates_by_axis(2, r, b);
}

bool LightSides::separates_by_side(const Vec3& d, const Box& r, double near, double far, const Box& b) const {
  const double highest = glm::dot(d, r.middle) + extent(d, r.half);
  if (distant_) {
    const Vec3 n = d + radius_ * normal_;
    const double limit = glm::dot(n, r.middle) + extent(n, r.half);
    return glm::dot(n, b.middle) - extent(n, b.half) >
           limit + kFarAboveRounding * (1.0 + radius_) * (b.reach + r.reach);
  }
  const double over = highest - radius_, slope = over > 0.0 ? over / near : over / far;
  const Vec3 n = d - slope * normal_;
  const double size = (1.0 + std::abs(slope)) * b.reach + radius_ + (r.reach + radius_) / near * b.reach;
  return glm::dot(n, b.middle) - extent(n, b.half) > radius_ + kFarAboveRounding * size;
}

bool LightSides::separates_by_axis(int axis, const Box& r, const Box& b) const {
  const double w = normal_[axis], across = radius_ * std::sqrt(std::max(0.0, 1.0 - w * w));
  const double margin = kFarAboveRounding * (r.reach + b.reach + radius_);
  // The light's extent along the axis, or how far its directions lean to either side.
  const double light_low = distant_ ? -w - across : -across, light_high = distant_ ? -w + across : across;
  const double low = r.middle[axis] - r.half[axis], high = r.middle[axis] + r.half[axis];
  const double caster_low = b.middle[axis] - b.half[axis], caster_high = b.middle[axis] + b.half[axis];
  if (distant_)
    return (light_high < -kFarAboveRounding && caster_low > high + margin) ||
           (light_low > kFarAboveRounding && caster_high < low - margin);
  return caster_low > std::max(high, light_high) + margin || caster_high < std::min(low, light_low) - margin;
}

}  // namespace penumbra::detail
