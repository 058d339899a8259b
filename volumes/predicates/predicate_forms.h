// The polynomials behind predicates.h, written once and evaluated in three kinds of arithmetic.
//
// An `Arithmetic` supplies `value(x)`, `difference(x, y)` (of doubles, x - y) and `sign(form)`, which is
// empty where that arithmetic cannot tell. Notation as in predicates.h: E = b - a the edge, N = E × (q - a)
// the plane of edge and point, w = center - a, m the light's normal of any length, r its radius.
#pragma once

#include <array>
#include <optional>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

template <class T>
struct Triple {
  T x, y, z;
};

template <class A, class B>
auto cross(const Triple<A>& a, const Triple<B>& b) {
  using T = decltype(a.y * b.z - a.z * b.y);
  return Triple<T>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class A, class B>
auto dot(const Triple<A>& a, const Triple<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
auto squared(const T& x) {
  return x * x;
}

template <class Arithmetic>
auto values(const Vec3& p) {
  using T = decltype(Arithmetic::value(p.x));
  return Triple<T>{Arithmetic::value(p.x), Arithmetic::value(p.y), Arithmetic::value(p.z)};
}

template <class Arithmetic>
auto differences(const Vec3& p, const Vec3& q) {
  using T = decltype(Arithmetic::difference(p.x, q.x));
  return Triple<T>{Arithmetic::difference(p.x, q.x), Arithmetic::difference(p.y, q.y),
                   Arithmetic::difference(p.z, q.z)};
}

template <class Arithmetic>
std::optional<Sign> orient3d_in(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto normal = cross(differences<Arithmetic>(b, a), differences<Arithmetic>(c, a));
  return Arithmetic::sign(dot(normal, differences<Arithmetic>(d, a)));
}

template <class Arithmetic>
std::optional<Sign> side_of_light_plane_in(const Vec3& p, const DiskLight& light) {
  return Arithmetic::sign(dot(values<Arithmetic>(light.normal), differences<Arithmetic>(p, light.center)));
}

/// Whether a, b and c lie on one line.
template <class Arithmetic>
std::optional<bool> collinear_in(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto normal = cross(differences<Arithmetic>(b, a), differences<Arithmetic>(c, a));
  const std::optional<Sign> x = Arithmetic::sign(normal.x), y = Arithmetic::sign(normal.y),
                            z = Arithmetic::sign(normal.z);
  const auto differs = [](const std::optional<Sign>& s) { return s && *s != Sign::kZero; };
  if (differs(x) || differs(y) || differs(z)) return false;
  if (x && y && z) return true;
  return std::nullopt;
}

/// How the disk lies to the plane of (a, b, c).
template <class Center, class Tangency>
struct DiskToPlane {
  Center center;      ///< d = N·(center - a)
  Tangency tangency;  ///< d²(m·m) - r²|N × m|²: positive iff the plane misses the closed disk, zero iff it
                      ///< touches the rim
};

template <class Arithmetic>
auto disk_to_plane(const Vec3& a, const Vec3& b, const Vec3& c, const DiskLight& light) {
  const auto normal = cross(differences<Arithmetic>(b, a), differences<Arithmetic>(c, a));
  const auto m = values<Arithmetic>(light.normal);
  const auto center = dot(normal, differences<Arithmetic>(light.center, a));
  const auto across = cross(normal, m);
  const auto tangency =
      squared(center) * dot(m, m) - squared(Arithmetic::value(light.radius)) * dot(across, across);
  return DiskToPlane<std::decay_t<decltype(center)>, std::decay_t<decltype(tangency)>>{center, tangency};
}

template <class Arithmetic>
std::optional<FaceClass> classify_face_in(const Vec3& a, const Vec3& b, const Vec3& c,
                                          const DiskLight& light) {
  const auto forms = disk_to_plane<Arithmetic>(a, b, c, light);
  const std::optional<Sign> tangency = Arithmetic::sign(forms.tangency);
  if (!tangency) return std::nullopt;
  if (*tangency != Sign::kPositive) return FaceClass::kMixed;
  const std::optional<Sign> center = Arithmetic::sign(forms.center);
  if (!center) return std::nullopt;
  return *center == Sign::kPositive ? FaceClass::kAllFront
                                    : FaceClass::kNoneFront;  // tangency > 0 rules out d = 0
}

/// The line a + tE meets the light's plane at t = (m·w)/(m·E), and there, scaled by m·E, the vector from the
/// center is (m·w)E - (m·E)w = m × (E × w). So |m × (E × w)|² - r²(m·E)² has the wanted sign where m·E ≠ 0;
/// where m·E = 0 ≠ m·w it is positive, as it should; where both vanish the line lies in the plane and |E ×
/// w|² - r²|E|² decides.
template <class Arithmetic>
std::optional<Sign> line_outside_disk_in(const Vec3& a, const Vec3& b, const DiskLight& light) {
  const auto edge = differences<Arithmetic>(b, a);
  const auto moment = cross(edge, differences<Arithmetic>(light.center, a));
  const auto m = values<Arithmetic>(light.normal);
  const auto slope = dot(m, edge);
  const auto offset = cross(m, moment);
  const auto radius2 = squared(Arithmetic::value(light.radius));
  const std::optional<Sign> crossing = Arithmetic::sign(dot(offset, offset) - radius2 * squared(slope));
  if (!crossing || *crossing != Sign::kZero) return crossing;
  const std::optional<Sign> slope_sign = Arithmetic::sign(slope);
  if (!slope_sign || *slope_sign != Sign::kZero) return slope_sign ? crossing : std::nullopt;
  return Arithmetic::sign(dot(moment, moment) - radius2 * dot(edge, edge));
}

/// Seen along the edge, the disk is an ellipse and the edge a point O outside of it. The two tangents from O
/// bound a wedge that holds the ellipse, its mirror image through O, and two side wedges. The line through O
/// parallel to the chord of contact (O's polar) separates the wedge (positive) from its mirror image:
///   (E×w · E×m)(N · E×m) + (E·m)²(E×w · N),  N = E × (q - a).
/// (In coordinates u1 along m - (m·e)e and u2: the ellipse has semi-axes r|e·m| and r, the polar's normal is
/// (w1, (e·m)² w2).)
template <class Arithmetic>
auto wedge_form(const Vec3& a, const Vec3& b, const Vec3& q, const DiskLight& light) {
  const auto edge = differences<Arithmetic>(b, a);
  const auto m = values<Arithmetic>(light.normal);
  const auto to_center = cross(edge, differences<Arithmetic>(light.center, a));
  const auto to_point = cross(edge, differences<Arithmetic>(q, a));
  const auto edge_m = cross(edge, m);
  return dot(to_center, edge_m) * dot(to_point, edge_m) + squared(dot(edge, m)) * dot(to_center, to_point);
}

/// The first tangent bounds the wedge clockwise, seen against a → b; its disk side is counter-clockwise of
/// it.
///  - The plane (a, b, q) misses the disk: q is in a side wedge. N·(center - a) > 0 says that it is the
///    clockwise one: beyond the first tangent, on the disk's side of the second.
///  - It meets the open disk: q is in the wedge (positive for both) or in its mirror image (negative for
///    both).
///  - It touches: q is on the tangent that those two signs name.
template <class Arithmetic>
std::optional<std::array<Sign, 2>> sides_of_tangent_planes_in(const Vec3& a, const Vec3& b, const Vec3& q,
                                                              const DiskLight& light) {
  using Sides = std::array<Sign, 2>;  // of kFirst, of kSecond
  const auto forms = disk_to_plane<Arithmetic>(a, b, q, light);
  const std::optional<Sign> tangency = Arithmetic::sign(forms.tangency);
  if (!tangency) return std::nullopt;
  const auto wedge = [&] { return Arithmetic::sign(wedge_form<Arithmetic>(a, b, q, light)); };
  if (*tangency == Sign::kNegative) {
    const std::optional<Sign> side = wedge();
    return side ? std::optional(Sides{*side, *side}) : std::nullopt;
  }
  const std::optional<Sign> center = Arithmetic::sign(forms.center);
  if (!center) return std::nullopt;
  if (*center == Sign::kZero)  // q on the edge's line, or in a plane that is both tangents
    return Sides{Sign::kZero, Sign::kZero};
  const bool clockwise = *center == Sign::kPositive;
  if (*tangency == Sign::kPositive)
    return clockwise ? Sides{Sign::kNegative, Sign::kPositive} : Sides{Sign::kPositive, Sign::kNegative};
  const std::optional<Sign> side = wedge();
  if (!side) return std::nullopt;
  const bool on_first = clockwise == (*side == Sign::kPositive);
  return on_first ? Sides{Sign::kZero, *side} : Sides{*side, Sign::kZero};
}

}  // namespace penumbra::detail
