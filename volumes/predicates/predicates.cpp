#include "penumbra/volumes/predicates/predicates.h"

#include "volumes/predicates/filtered.h"
#include "volumes/predicates/predicate_forms.h"
#include "volumes/predicates/predicate_tiers.h"

namespace penumbra {

namespace detail::filter {

std::optional<FaceClass> classify_face(const Vec3& a, const Vec3& b, const Vec3& c,
                                       const CircularLight& light) {
  return classify_face_in<FilterArithmetic>(a, b, c, light);
}

std::optional<Sign> orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return orient3d_in<FilterArithmetic>(a, b, c, d);
}

std::optional<Sign> side_of_light_plane(const Vec3& p, const CircularLight& light) {
  return side_of_light_plane_in<FilterArithmetic>(p, light);
}

std::optional<Sign> line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light) {
  return line_outside_disk_in<FilterArithmetic>(a, b, light);
}

std::optional<std::array<Sign, 2>> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                                           const CircularLight& light) {
  return sides_of_tangent_planes_in<FilterArithmetic>(a, b, q, light);
}

std::optional<bool> collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  return collinear_in<FilterArithmetic>(a, b, c);
}

}  // namespace detail::filter

FaceClass classify_face(const Vec3& a, const Vec3& b, const Vec3& c, const CircularLight& light) {
  if (const auto result = detail::filter::classify_face(a, b, c, light)) return *result;
  if (const auto result = detail::interval::classify_face(a, b, c, light)) return *result;
  return detail::exact::classify_face(a, b, c, light);
}

Sign orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (const auto result = detail::filter::orient3d(a, b, c, d)) return *result;
  if (const auto result = detail::interval::orient3d(a, b, c, d)) return *result;
  return detail::exact::orient3d(a, b, c, d);
}

Sign side_of_light_plane(const Vec3& p, const CircularLight& light) {
  if (const auto result = detail::filter::side_of_light_plane(p, light)) return *result;
  if (const auto result = detail::interval::side_of_light_plane(p, light)) return *result;
  return detail::exact::side_of_light_plane(p, light);
}

Sign line_outside_disk(const Vec3& a, const Vec3& b, const CircularLight& light) {
  if (const auto result = detail::filter::line_outside_disk(a, b, light)) return *result;
  if (const auto result = detail::interval::line_outside_disk(a, b, light)) return *result;
  return detail::exact::line_outside_disk(a, b, light);
}

std::array<Sign, 2> sides_of_tangent_planes(const Vec3& a, const Vec3& b, const Vec3& q,
                                            const CircularLight& light) {
  if (const auto result = detail::filter::sides_of_tangent_planes(a, b, q, light)) return *result;
  if (const auto result = detail::interval::sides_of_tangent_planes(a, b, q, light)) return *result;
  return detail::exact::sides_of_tangent_planes(a, b, q, light);
}

Sign side_of_tangent_plane(const Vec3& a, const Vec3& b, const Vec3& q, Tangent which,
                           const CircularLight& light) {
  return sides_of_tangent_planes(a, b, q, light)[static_cast<std::size_t>(which)];
}

bool detail::collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (const auto result = filter::collinear(a, b, c)) return *result;
  if (const auto result = interval::collinear(a, b, c)) return *result;
  return exact::collinear(a, b, c);
}

}  // namespace penumbra
