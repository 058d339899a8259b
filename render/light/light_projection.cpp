#include "render/light/light_projection.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace penumbra {

LightProjection::LightProjection(const AreaLight& light, const Vec3& middle, double least_depth)
    : axes_(light.axes), center_(light.center), origin_(middle), spread_(light.half) {
  if (light.distant) return;
  const double found = glm::dot(middle - center_, axes_.w), depth = std::max(found, least_depth);
  origin_ += (depth - found) * axes_.w;
  nearness_ = 1.0 / depth;
  tilt_ = glm::dvec2(direction(center_ - origin_)) / depth;
  spread_ = light.half / depth;
}

Vec3 LightProjection::direction(const Vec3& world) const {
  return {glm::dot(world, axes_.u), glm::dot(world, axes_.v), glm::dot(world, axes_.w)};
}

/// The third coefficient is the height of the light's center above the plane, over the origin's depth.
Vec3 LightProjection::plane(const Vec3& normal, const Vec3& point) const {
  const double up = nearness_ > 0.0 ? nearness_ * glm::dot(normal, center_ - point)
                                    : tilt_.x * glm::dot(normal, axes_.u) +
                                          tilt_.y * glm::dot(normal, axes_.v) - glm::dot(normal, axes_.w);
  return {glm::dot(normal, axes_.u), glm::dot(normal, axes_.v), up};
}

LightProjection LightProjection::seen_from(const glm::dvec2& d) const {
  LightProjection out = *this;
  const glm::dvec2 shift = spread_ * d;
  out.tilt_ += shift;
  if (nearness_ > 0.0) out.center_ += (shift.x * axes_.u + shift.y * axes_.v) / nearness_;
  return out;
}

}  // namespace penumbra
