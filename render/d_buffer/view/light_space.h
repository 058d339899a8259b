// D-buffer: the space in which everything is drawn and looked up, for lights at any distance.
//
// In: a disk, near or distant, and a point near its receivers. Out: coordinates (u, v, h) in double. (u, v)
// is where the light's center sees a point, h its height towards the light (render/light/light_projection.h),
// scaled so that the way from a receiver to the point d of the unit disk runs along (d, 1):
//
//   a point p lies, seen from x, at d = (p_uv - x_uv) / (p_h - x_h) of the unit disk.
//
// Every plane that touches the disk has the slope 1, and the boundary at a vertex is a circular cone of slope
// 1. A window is part of the space: coordinates are relative to its middle and to its lowest receiver, in
// units of its width. So float keeps its digits where receivers are, wherever the light is and a floor ends.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "render/light/light_projection.h"

namespace penumbra::detail {

/// A point in (u, v, h).
struct Uvh {
  glm::dvec2 uv;
  double h;
};

/// Of a point in homogeneous coordinates. Precondition: p.w > 0.
inline Uvh divided(const glm::dvec4& p) {
  return {glm::dvec2(p) / p.w, p.z / p.w};
}

class LightSpace {
 public:
  /// Accuracy: nothing is drawn where the weight is less.
  static constexpr double kNearWeight = 0x1p-24;

  /// Relative to the origin of the projection and in scene units. For `least_depth` see LightProjection.
  LightSpace(const CircularLight& light, const Vec3& middle, double least_depth);

  /// Relative to `zero`, in units of `unit`; both in this space, which has no window yet.
  LightSpace with_window(const Uvh& zero, double unit) const;
  /// From the space without a window.
  Uvh in_window(const Uvh& p) const { return {(p.uv - zero_.uv) / unit_, (p.h - zero_.h) / unit_}; }
  glm::dvec4 in_window(const glm::dvec4& p) const;

  /// (u, v, h, 1) · weight: linear in the point. The weight is the point's depth before the light over that
  /// of the origin. At 0 and below the point is not in front of the light.
  glm::dvec4 homogeneous(const Vec3& world) const;
  /// The plane through a point with a unit normal, as (a, b, c): (a, b, c) · ((u, v, h) of p - (u, v, h) of
  /// the point) is the height of p above it, divided by unit and weight of p. δ of a receiver's horizon is c
  /// / |(a, b)|.
  Vec3 plane(const Vec3& normal, const Vec3& point) const;

  const LightFrame& axes() const { return projection_.axes(); }
  bool is_orthographic() const { return projection_.nearness() == 0.0; }
  /// Of the origin before the light, scene units. Precondition: not orthographic.
  double depth() const { return 1.0 / projection_.nearness(); }
  /// In the space without a window: (u, v) of the light's own axis, h of points at infinite depth.
  /// Precondition: not orthographic.
  Uvh end_of_axis() const;
  /// The disk's radius over the depth of the origin.
  double spread() const { return projection_.spread().x; }

 private:
  LightProjection projection_;
  /// Of the window.
  Uvh zero_{glm::dvec2(0.0), 0.0};
  double unit_ = 1.0;
};

}  // namespace penumbra::detail
