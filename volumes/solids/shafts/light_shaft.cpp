#include "volumes/solids/shafts/light_shaft.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"
#include "volumes/solids/shafts/closest_to_origin.h"

namespace penumbra::detail {
namespace {

/// Accuracy: of the extent. Some thousand roundings of coordinates as large as that.
constexpr double kMargin = 1e-12;
/// Accuracy: nearer than this part of the extent, shaft and triangle are taken to meet.
constexpr double kTouching = 1e-9;
constexpr int kMostSteps = 32;

/// Of the sides.
struct Directions {
  Directions() {
    for (int k = 0; k < LightShaft::kSides; ++k) {
      x[k] = std::cos(2.0 * std::numbers::pi * k / LightShaft::kSides);
      y[k] = std::sin(2.0 * std::numbers::pi * k / LightShaft::kSides);
    }
  }
  std::array<double, LightShaft::kSides> x, y;
};
const Directions kDirections;

}  // namespace

LightShaft::LightShaft(const CircularLight& light, const LightFrame& frame, std::span<const Vec3> points,
                       double extent)
    : origin_(points[0]), count_(static_cast<int>(points.size())), axis_(frame.w), margin_(kMargin * extent) {
  base_low_ = base_high_ = points[0];
  for (int i = 0; i < count_; ++i) {
    points_[i] = points[i] - origin_;
    base_low_ = glm::min(base_low_, points[i]);
    base_high_ = glm::max(base_high_, points[i]);
  }
  const double far = 2.0 * extent;
  if (light.is_distant()) {
    end_ = -far * axis_;
    radius_ = far * light.radius;
    kept_ = 1.0;
  } else {
    const Vec3 to_center = light.center - origin_;
    const double height = -glm::dot(to_center, axis_);
    const double lambda = height > far ? far / height : 1.0;
    end_ = lambda * to_center;
    radius_ = lambda * light.radius;
    kept_ = 1.0 - lambda;
  }
  // Side k touches T and the end: normal d + σm with the least σ at which T reaches as far along it as the
  // end.
  const double height = -glm::dot(end_, axis_);
  for (int k = 0; k < kSides; ++k) {
    const Vec3 d = kDirections.x[k] * frame.u + kDirections.y[k] * frame.v;
    double sigma = 1e30;
    for (int i = 0; i < count_; ++i) {
      const double slope = (radius_ + glm::dot(d, end_) - (1.0 - kept_) * glm::dot(d, points_[i])) /
                           (height + (1.0 - kept_) * glm::dot(axis_, points_[i]));
      sigma = std::min(sigma, slope);
    }
    const Vec3 normal = glm::normalize(d + sigma * axis_);
    sides_[k] = {normal, glm::dot(normal, farthest(normal, false)) + margin_};
  }
  sides_[kSides] = {axis_, glm::dot(axis_, farthest(axis_, true)) + margin_};
}

Vec3 LightShaft::farthest(const Vec3& v, bool base_only) const {
  int best = 0;
  double most = glm::dot(v, points_[0]);
  for (int i = 1; i < count_; ++i) {
    const double along = glm::dot(v, points_[i]);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  if (base_only) return points_[best];
  const Vec3 across = v - glm::dot(v, axis_) * axis_;
  const double length = glm::length(across);
  const Vec3 end = kept_ * points_[best] + end_ + (length > 0.0 ? (radius_ / length) * across : Vec3(0.0));
  return glm::dot(v, end) > most ? end : points_[best];
}

bool LightShaft::misses_box(const Vec3& low, const Vec3& high) const {
  const Vec3 middle = 0.5 * (low + high) - origin_, half = 0.5 * (high - low);
  return std::any_of(sides_.begin(), sides_.end(), [&](const Side& s) {
    return glm::dot(s.normal, middle) - glm::dot(glm::abs(s.normal), half) > s.offset;
  });
}

bool LightShaft::is_beyond_a_side(const std::array<Vec3, 3>& triangle) const {
  return std::any_of(sides_.begin(), sides_.end(), [&](const Side& s) {
    return glm::dot(s.normal, triangle[0]) > s.offset && glm::dot(s.normal, triangle[1]) > s.offset &&
           glm::dot(s.normal, triangle[2]) > s.offset;
  });
}

/// E. Gilbert, D. Johnson, S. Keerthi, "A fast procedure for computing the distance between complex objects
/// in three-dimensional space" (1988), stopped at the first direction that separates. That direction is the
/// proof; how it was found does not matter.
bool LightShaft::is_separate(const std::array<Vec3, 3>& triangle, bool base_only) const {
  const double touching = kTouching / kMargin * margin_;
  Vec3 v = (triangle[0] + triangle[1] + triangle[2]) / 3.0 - points_[0];
  ClosestToOrigin simplex;
  for (int step = 0; step < kMostSteps; ++step) {
    const double length = glm::length(v);
    if (!(length > touching)) return false;
    const Vec3* nearest = &triangle[0];
    for (int i = 1; i < 3; ++i)
      if (glm::dot(v, triangle[i]) < glm::dot(v, *nearest)) nearest = &triangle[i];
    const Vec3 w = *nearest - farthest(v, base_only);
    if (glm::dot(v, w) > margin_ * length) return true;
    if (!simplex.add(w)) return false;
    v = simplex.point();
  }
  return false;
}

bool LightShaft::misses(const Vec3& a, const Vec3& b, const Vec3& c) const {
  const std::array<Vec3, 3> triangle{a - origin_, b - origin_, c - origin_};
  return is_beyond_a_side(triangle) || is_separate(triangle, false);
}

std::uint32_t LightShaft::sides_beyond(const Vec3& p) const {
  const Vec3 from = p - origin_;
  std::uint32_t out = 0;
  for (std::size_t k = 0; k < sides_.size(); ++k)
    out |= glm::dot(sides_[k].normal, from) > sides_[k].offset ? std::uint32_t{1} << k : 0u;
  return out;
}

bool LightShaft::holds(const Vec3& p) const {
  const Vec3 from = p - origin_;
  const double share = glm::dot(from, axis_) / glm::dot(end_, axis_);
  if (!(share >= 0.0 && share <= 1.0)) return false;
  const Vec3 across = from - share * end_;
  return glm::dot(across, across) <= share * radius_ * share * radius_;
}

bool LightShaft::base_misses(const Vec3& a, const Vec3& b, const Vec3& c) const {
  for (int k = 0; k < 3; ++k)
    if (std::max({a[k], b[k], c[k]}) < base_low_[k] || std::min({a[k], b[k], c[k]}) > base_high_[k])
      return true;
  return is_separate({a - origin_, b - origin_, c - origin_}, true);
}

}  // namespace penumbra::detail
