#include "penumbra/volumes/tangent_planes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "mesh/vectors.h"
#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra {

namespace {

/// The plane perpendicular to the edge, in which the edge is the origin and the disk an ellipse about (w1,
/// w2) with semi-axes radius·|slope| along u1 and radius along u2. u1 × u2 = e.
struct EdgeView {
  Vec3 u1, u2;
  double slope;   ///< e·m
  double w1, w2;  ///< the center, divided by `scale`
  double radius;  ///< divided by `scale`
};

EdgeView view_along(const Vec3& e, const Vec3& v1, const Vec3& m, const CircularLight& light) {
  Vec3 u2 = glm::cross(e, m);
  // Where e is nearly parallel to m the cross product is short and its error not; project once more.
  u2 = glm::dot(u2, u2) > 0.0 ? detail::unit(u2) : detail::unit_perpendicular(e);
  u2 = glm::normalize(u2 - glm::dot(u2, e) * e);
  const Vec3 u1 = glm::cross(u2, e);
  const Vec3 w = way_to_center(light, v1);
  const double largest = std::max(detail::largest_component(w), light.radius);
  const double scale = largest > 0.0 ? largest : 1.0;
  const Vec3 scaled(w.x / scale, w.y / scale, w.z / scale);
  return {u1, u2, glm::dot(e, m), glm::dot(scaled, u1), glm::dot(scaled, u2), light.radius / scale};
}

struct Normal2 {
  double alpha, beta;
};

/// Both roots of q(α, β) = q00 α² + 2 q01 αβ + q11 β² = (n·w)² - r²|m × n|². Each is (-q01 ± √-det, q00),
/// which is parallel to (q11, -q01 ∓ √-det): of the two the one without cancellation is taken. In this basis
/// -det = r²(w1² + slope²(w2² - r²)).
std::array<Normal2, 2> tangent_normals(const EdgeView& v) {
  const double half_axis = v.radius * v.slope;
  const double q00 = (v.w1 - half_axis) * (v.w1 + half_axis), q01 = v.w1 * v.w2;
  const double q11 = (v.w2 - v.radius) * (v.w2 + v.radius);
  const double inside = v.w1 * v.w1 + v.slope * v.slope * q11;
  const double root = v.radius * std::sqrt(std::max(inside, 0.0));
  if (q01 == 0.0 &&
      root == 0.0) {  // a double root along an axis, or (all zero) the line touches the disk in its plane
    const Normal2 n = std::abs(q11) >= std::abs(q00) ? Normal2{1.0, 0.0} : Normal2{0.0, 1.0};
    return {n, n};
  }
  if (q01 > 0.0) return {Normal2{q11, -q01 - root}, Normal2{-q01 - root, q00}};
  return {Normal2{root - q01, q00}, Normal2{q11, root - q01}};
}

/// The way from v1 to the disk's extreme point against the normal, and that point.
TangentPlane plane_with(const Vec3& normal, const Vec3& v1, const CircularLight& light) {
  const CircularLight around_zero(Vec3(0.0), light.normal, light.radius);
  return {normal, extreme_points(light, normal).far,
          way_to_center(light, v1) + extreme_points(around_zero, normal).far};
}

/// Where center - contact points, up to a positive factor: (e × (contact - v1))·(center - v1) without the
/// cancellation.
double turn_from_contact(const EdgeView& v, const Normal2& n) {
  const double across = std::hypot(v.slope * n.alpha, n.beta);  // |m × n|
  return across > 0.0 ? (v.w1 * n.beta - v.w2 * v.slope * v.slope * n.alpha) / across : 0.0;
}

}  // namespace

std::optional<std::array<TangentPlane, 2>> tangent_planes(const Vec3& v1, const Vec3& v2,
                                                          const CircularLight& light) {
  const Sign outside = line_outside_disk(v1, v2, light);
  if (outside == Sign::kNegative || (outside == Sign::kZero && light.radius == 0.0)) return std::nullopt;
  const Vec3 e = detail::unit(v2 - v1), m = detail::unit(light.normal);
  const EdgeView view = view_along(e, v1, m, light);
  if (light.radius == 0.0 && view.w1 == 0.0 && view.w2 == 0.0) return std::nullopt;

  // 1. The two normals, the disk on their positive side; the first tangent is clockwise of the center.
  std::array<Normal2, 2> roots = tangent_normals(view);
  for (Normal2& n : roots) {
    const double length = std::hypot(n.alpha, n.beta);
    n = {n.alpha / length, n.beta / length};
    if (n.alpha * view.w1 + n.beta * view.w2 < 0.0) n = {-n.alpha, -n.beta};
  }
  if (turn_from_contact(view, roots[0]) < turn_from_contact(view, roots[1])) std::swap(roots[0], roots[1]);

  // 2. Where both are the plane through the whole disk (a point light, or an edge in the light's plane), as
  //    in the limit: the first normal is to the left of the center, the second to the right.
  const bool in_light_plane = view.slope == 0.0 && view.w1 == 0.0;
  if (light.radius == 0.0) {
    const double length = std::hypot(view.w1, view.w2);
    roots[0] = {-view.w2 / length, view.w1 / length};
    roots[1] = {-roots[0].alpha, -roots[0].beta};
  } else if (in_light_plane) {
    roots[0] = {view.w2 > 0.0 ? -1.0 : 1.0, 0.0};
    roots[1] = {-roots[0].alpha, 0.0};
  }

  // 3. Back to space.
  std::array<TangentPlane, 2> planes;
  for (int i = 0; i < 2; ++i) {
    planes[i] = plane_with(glm::normalize(roots[i].alpha * view.u1 + roots[i].beta * view.u2), v1, light);
    if (!in_light_plane || light.radius == 0.0) continue;
    planes[i].contact = light.center;
    planes[i].way = way_to_center(light, v1);
  }
  return planes;
}

}  // namespace penumbra
