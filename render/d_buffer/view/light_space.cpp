#include "render/d_buffer/view/light_space.h"

namespace penumbra::detail {

LightSpace::LightSpace(const CircularLight& light, const Vec3& middle, double least_depth)
    : projection_({.axes = light_frame(light),
                   .center = light.center,
                   .half = glm::dvec2(light.radius),
                   .distant = light.is_distant()},
                  middle, least_depth) {}

LightSpace LightSpace::with_window(const Uvh& zero, double unit) const {
  LightSpace out = *this;
  out.zero_ = zero;
  out.unit_ = unit;
  return out;
}

glm::dvec4 LightSpace::in_window(const glm::dvec4& p) const {
  return {(glm::dvec2(p) - zero_.uv * p.w) / unit_, (p.z - zero_.h * p.w) / unit_, p.w};
}

glm::dvec4 LightSpace::homogeneous(const Vec3& world) const {
  const Vec3 p = projection_.local(world);
  return in_window({projection_.place(p), -spread() * p.z, projection_.weight(p)});
}

Vec3 LightSpace::plane(const Vec3& normal, const Vec3& point) const {
  const Vec3 plane = projection_.plane(normal, point);
  return {plane.x, plane.y, plane.z / spread()};
}

Uvh LightSpace::end_of_axis() const {
  return {projection_.tilt() * depth(), -spread() * depth()};
}

}  // namespace penumbra::detail
