#include "render/silhouette/edges/unit_light.h"

namespace penumbra::detail {
namespace {

// Accuracy. Held by the tests UnitLight.
/// A light is far at this many times the radius of what is asked about. Nearer ones lose at most a digit.
constexpr double kFar = 8.0;
/// S over that radius. More leaves lengths more alike, less leaves more digits.
constexpr double kBeyond = 3.0;

/// Turned about w by a little more than half a radian. The slope is the golden section: it is far from the
/// slopes of regular patterns.
LightFrame turned(const LightFrame& axes) {
  constexpr double kCosine = 0.85065080835203993, kSine = 0.52573111211913361;
  return {kCosine * axes.u + kSine * axes.v, kCosine * axes.v - kSine * axes.u, axes.w};
}

}  // namespace

UnitLight::UnitLight(const CircularLight& light, const Bounds& asked_about)
    : light_(light),
      axes_(turned(light_frame(DiskLight{.normal = light.normal}))),
      origin_(light.center),
      across_(light.radius * axes_.u),
      up_(light.radius * axes_.v),
      per_radius_(1.0 / light.radius) {
  const double radius = asked_about.empty() ? 0.0 : 0.5 * glm::distance(asked_about.low, asked_about.high);
  const double reach = radius > 0.0 ? radius : 1.0;
  if (light.is_distant())
    look_from_afar(asked_about, reach);
  else if (!asked_about.empty() && glm::dot(asked_about.center() - light.center, axes_.w) > kFar * reach)
    look_from_afar(asked_about, reach);
}

void UnitLight::look_from_afar(const Bounds& asked_about, double reach) {
  projective_ = true;
  origin_ = asked_about.empty() ? Vec3(0.0) : asked_about.center();
  beyond_ = kBeyond * reach;
  if (light_.is_distant()) {
    k_ = 1.0 / light_.radius;
    return;
  }
  const Vec3 from_center = direction(origin_ - light_.center);
  per_distance_ = 1.0 / from_center.z;
  tilt_ = glm::dvec2(from_center) * per_distance_;
  k_ = (beyond_ + from_center.z) / light_.radius;
}

Vec3 UnitLight::projected(const Vec3& d) const {
  const double g = k_ / (beyond_ - d.z);
  return {(d.x - d.z * tilt_.x) * g, (d.y - d.z * tilt_.y) * g,
          g * (1.0 + d.z * per_distance_) * beyond_ / (1.0 + beyond_ * per_distance_)};
}

/// With K = k S / (1 + S/D) and h = z + K/D, which is positive, the inverse map times h is linear:
///   a h = S x + t_u (S z - K),  b h = S y + t_v (S z - K),  s h = S z - K.
/// So n·(a, b, s) + offset, times h, is linear in the frame's coordinates, with the gradient below.
Vec3 UnitLight::plane_normal(const Vec3& world, const Vec3& normal) const {
  if (!projective_ || normal == Vec3(0.0)) return direction(normal);
  const Vec3 n = direction(normal);
  const double offset = -glm::dot(normal, world - origin_);
  return glm::normalize(
      Vec3(beyond_ * n.x, beyond_ * n.y, beyond_ * (tilt_.x * n.x + tilt_.y * n.y + n.z) + offset));
}

UnitLight::Plane UnitLight::world_plane(const Vec3& normal, double offset) const {
  if (!projective_) return {per_radius_ * world_direction(normal), offset};
  const double depth = k_ * beyond_ / (1.0 + beyond_ * per_distance_);
  const Vec3 n{k_ * normal.x, k_ * normal.y,
               -k_ * (tilt_.x * normal.x + tilt_.y * normal.y) + depth * per_distance_ * normal.z - offset};
  return {world_direction(n), depth * normal.z + beyond_ * offset};
}

}  // namespace penumbra::detail
