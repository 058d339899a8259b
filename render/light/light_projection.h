// Lights at any distance as their receivers see them: one map for near, far and distant lights.
//
// In: a light and an origin near the receivers. Out: coordinates in double that keep their digits wherever
// the light is. Local coordinates (u, v, w) are relative to the origin: u and v along the light's plane, w
// away from the light. Seen from the light's center a point lies at the place q where its line of sight
// crosses the plane w = 0 through the origin, and at the height h towards the light:
//
//   q = ((u, v) + tilt · w) / weight      h = -w / weight      weight = 1 + nearness · w
//
// nearness is 1 / (the origin's depth before the light), tilt the light's center over that depth. Of a
// distant light both are 0, and the map is orthographic. The map is projective: lines stay lines and planes
// planes. In (q, h) every light is a distant one: with d a point of the light in units of its half extents,
// the way from a receiver towards it runs along (spread · d, 1).
#pragma once

#include <glm/vec2.hpp>

#include "render/light/area_light.h"

namespace penumbra {

class LightProjection {
 public:
  /// The origin is `middle`; of a near light it is moved away from the light's plane where it is not
  /// `least_depth` > 0 in front of it.
  LightProjection(const AreaLight& light, const Vec3& middle, double least_depth);

  const LightFrame& axes() const { return axes_; }
  const Vec3& origin() const { return origin_; }
  double nearness() const { return nearness_; }
  const glm::dvec2& tilt() const { return tilt_; }
  /// The light's half extents over the origin's depth: tangents of half the angles that it fills there.
  const glm::dvec2& spread() const { return spread_; }

  /// Local coordinates of a point, and of a direction.
  Vec3 local(const Vec3& world) const { return direction(world - origin_); }
  Vec3 direction(const Vec3& world) const;
  /// The depth before the light over that of the origin: 0 on the light's plane, negative behind it; 1 under
  /// a distant light.
  double weight(const Vec3& local) const { return 1.0 + nearness_ * local.z; }
  /// w of the light's plane: -infinity of a distant light.
  double plane_depth() const { return -1.0 / nearness_; }
  /// q, not divided by the weight.
  glm::dvec2 place(const Vec3& local) const { return glm::dvec2(local) + tilt_ * local.z; }
  /// The plane through a point with a unit normal, as the coefficients of (q, h): normal · (p - point) is
  /// this · ((q, h) of p - (q, h) of point) · weight of p.
  Vec3 plane(const Vec3& normal, const Vec3& point) const;
  /// The same with another point of the light for its center, `d` in units of its half extents. Heights stay,
  /// and q becomes q - spread · d · h.
  LightProjection seen_from(const glm::dvec2& d) const;

 private:
  LightFrame axes_;
  Vec3 center_, origin_;
  double nearness_ = 0.0;
  glm::dvec2 tilt_{0.0}, spread_;
};

}  // namespace penumbra
