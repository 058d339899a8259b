// The oracle's contract in rational numbers, face by face: slow, and written apart from the oracle. It solves
// for the point where ray and plane meet and looks on which side of the edges that point lies, where the
// oracle takes signs of determinants.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstddef>

#include "penumbra/mesh/triangle_mesh.h"
#include "tests/oracle/signs.h"

namespace penumbra::oracle {

using Rational = mpq_class;
using RationalPoint = std::array<Rational, 3>;

inline RationalPoint exact(const Vec3& p) {
  return {Rational(p.x), Rational(p.y), Rational(p.z)};
}
inline RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Rational dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The corners of a face, and x as the fourth point.
using FacePoints = std::array<RationalPoint, 4>;

/// Six times the volume of the four points.
inline Rational volume(const FacePoints& p) {
  return dot(minus(p[0], p[3]), cross(minus(p[1], p[0]), minus(p[2], p[0])));
}

/// Whether four roundings of every coordinate can make the volume 0, to first order. It is linear in each
/// coordinate, so a derivative is the change by one unit.
inline bool is_flat(const FacePoints& points) {
  const Rational whole = volume(points);
  Rational reach = 0;
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t i = 0; i < 3; ++i) {
      FacePoints moved = points;
      moved[v][i] += 1;
      const Rational derivative = volume(moved) - whole;
      reach += abs(derivative) * abs(points[v][i]);
    }
  return abs(whole) <= Rational(4 * 0x1p-53) * reach;
}

enum class Meeting { kMisses, kInside, kOnTheRim, kFlat };

/// How a ray, open at both ends, meets a face. kFlat: it would, but the face's plane contains x.
inline Meeting meeting_of(const Ray& ray, const std::array<Vec3, 3>& face) {
  const FacePoints points = {exact(face[0]), exact(face[1]), exact(face[2]), exact(ray.x)};
  const RationalPoint d = ray.endless ? exact(ray.q) : minus(exact(ray.q), points[3]);
  const RationalPoint n = cross(minus(points[1], points[0]), minus(points[2], points[0]));
  const Rational along = dot(n, d);
  if (along == 0) return Meeting::kMisses;
  const Rational t = dot(n, minus(points[0], points[3])) / along;
  RationalPoint at = points[3];
  for (std::size_t i = 0; i < 3; ++i) at[i] += t * d[i];
  if (t < 0) return Meeting::kMisses;
  const bool is_before_light = ray.endless || dot(exact(ray.normal), minus(at, exact(ray.center))) > 0;
  if (!is_before_light) return Meeting::kMisses;
  bool rim = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const RationalPoint edge = minus(points[(i + 1) % 3], points[i]);
    const int side = sgn(dot(cross(edge, minus(at, points[i])), n));
    if (side < 0) return Meeting::kMisses;
    rim = rim || side == 0;
  }
  if (is_flat(points)) return Meeting::kFlat;
  return rim ? Meeting::kOnTheRim : Meeting::kInside;
}

}  // namespace penumbra::oracle
