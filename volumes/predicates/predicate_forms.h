// The polynomials behind predicates.h, written once and evaluated in three kinds of arithmetic.
//
// An `Arithmetic` supplies `value(x)`, `difference(x, y)` (of doubles, x - y) and `sign(form)`, which is
// empty where that arithmetic cannot tell. Notation as in predicates.h: E = b - a the edge, N = E × (q - a)
// the plane of edge and point, w = center - weight·a, m the light's normal of any length, r its radius.
//
// A distant light (weight 0) has w = -m, and the way to a point of its rim is, up to length, -m + r|m|e with
// a unit vector e perpendicular to m. So its forms are those of a disk about w with the radius r|m|. Where a
// form has the factor m·m throughout then, it is divided out.
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

/// w. The product is exact, since the weight is 0 or 1.
template <class Arithmetic>
auto way_to_center(const CircularLight& light, const Vec3& a) {
  return differences<Arithmetic>(light.center, light.weight * a);
}

template <class Arithmetic>
std::optional<Sign> orient3d_in(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto normal = cross(differences<Arithmetic>(b, a), differences<Arithmetic>(c, a));
  return Arithmetic::sign(dot(normal, differences<Arithmetic>(d, a)));
}

template <class Arithmetic>
std::optional<Sign> side_of_light_plane_in(const Vec3& p, const CircularLight& light) {
  if (light.is_distant()) return Sign::kPositive;
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
  /// d = N·w
  Center center;
  /// d²(m·m) - r²|N × m|², of a distant light d² - r²|N × m|²: positive iff the plane misses the closed disk,
  /// zero iff it touches the rim.
  Tangency tangency;
};

template <class Arithmetic>
auto disk_to_plane(const Vec3& a, const Vec3& b, const Vec3& c, const CircularLight& light) {
  const auto normal = cross(differences<Arithmetic>(b, a), differences<Arithmetic>(c, a));
  const auto m = values<Arithmetic>(light.normal);
  const auto measure = light.is_distant() ? values<Arithmetic>(Vec3(1.0, 0.0, 0.0)) : m;
  const auto center = dot(normal, way_to_center<Arithmetic>(light, a));
  const auto across = cross(normal, m);
  const auto tangency = squared(center) * dot(measure, measure) -
                        squared(Arithmetic::value(light.radius)) * dot(across, across);
  return DiskToPlane<std::decay_t<decltype(center)>, std::decay_t<decltype(tangency)>>{center, tangency};
}

template <class Arithmetic>
std::optional<FaceClass> classify_face_in(const Vec3& a, const Vec3& b, const Vec3& c,
                                          const CircularLight& light) {
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
/// w|² - r²|E|² decides. To a distant light the line goes in the direction E, whatever a is. With w = -m it
/// is |m × (E × w)|² = (m·m)|E × w|², so |E × w|² - r²(m·E)² decides. It is positive where m·E = 0.
template <class Arithmetic>
std::optional<Sign> line_outside_disk_in(const Vec3& a, const Vec3& b, const CircularLight& light) {
  const auto edge = differences<Arithmetic>(b, a);
  const auto moment = cross(edge, way_to_center<Arithmetic>(light, a));
  const auto m = values<Arithmetic>(light.normal);
  const auto slope = dot(m, edge);
  const auto radius2 = squared(Arithmetic::value(light.radius));
  if (light.is_distant()) return Arithmetic::sign(dot(moment, moment) - radius2 * squared(slope));
  const auto offset = cross(m, moment);
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
/// Of a distant light, with w = -m, it is (m·m)(E·E)(E×w · N).
template <class Arithmetic>
std::optional<Sign> side_of_polar_in(const Vec3& a, const Vec3& b, const Vec3& q,
                                     const CircularLight& light) {
  const auto edge = differences<Arithmetic>(b, a);
  const auto m = values<Arithmetic>(light.normal);
  const auto to_center = cross(edge, way_to_center<Arithmetic>(light, a));
  const auto to_point = cross(edge, differences<Arithmetic>(q, a));
  if (light.is_distant()) return Arithmetic::sign(dot(to_center, to_point));
  const auto edge_m = cross(edge, m);
  return Arithmetic::sign(dot(to_center, edge_m) * dot(to_point, edge_m) +
                          squared(dot(edge, m)) * dot(to_center, to_point));
}

/// The first tangent bounds the wedge clockwise, seen against a → b; its disk side is counter-clockwise of
/// it.
///  - The plane (a, b, q) misses the disk: q is in a side wedge. N·w > 0 says that it is the
///    clockwise one: beyond the first tangent, on the disk's side of the second.
///  - It meets the open disk: q is in the wedge (positive for both) or in its mirror image (negative for
///    both).
///  - It touches: q is on the tangent that those two signs name.
template <class Arithmetic>
std::optional<std::array<Sign, 2>> sides_of_tangent_planes_in(const Vec3& a, const Vec3& b, const Vec3& q,
                                                              const CircularLight& light) {
  using Sides = std::array<Sign, 2>;  // of kFirst, of kSecond
  const auto forms = disk_to_plane<Arithmetic>(a, b, q, light);
  const std::optional<Sign> tangency = Arithmetic::sign(forms.tangency);
  if (!tangency) return std::nullopt;
  const auto wedge = [&] { return side_of_polar_in<Arithmetic>(a, b, q, light); };
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
