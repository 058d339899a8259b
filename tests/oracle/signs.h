// Signs of polynomials in coordinates, always right: in double with a bound on the error, and by rational
// numbers where the bound leaves the sign open.
//
// Coordinates count as given and must be finite. Where products overflow or underflow, the rational numbers
// decide.
#pragma once

#include <optional>

#include "penumbra/mesh/types.h"

namespace penumbra::oracle {

/// A number in double, and how far the true value lies from it at most.
struct Bounded {
  double value = 0.0, error = 0.0;

  /// The sign of the true value: -1, 0 or 1. Nothing where the error leaves it open.
  std::optional<int> sign() const;
};
Bounded operator+(const Bounded& a, const Bounded& b);
Bounded operator-(const Bounded& a, const Bounded& b);
Bounded operator*(const Bounded& a, const Bounded& b);
Bounded abs(const Bounded& a);
/// a - b for two numbers that are exact.
Bounded difference(double a, double b);

/// The determinant of three rows, each component of which is a difference that was rounded once.
Bounded determinant(const Vec3& a, const Vec3& b, const Vec3& c);

/// The sign of n·(p - q).
int sign_of_dot(const Vec3& n, const Vec3& p, const Vec3& q);

/// A ray from x through q, which ends at the plane of a light: center and normal. Or, `endless`, from x in
/// direction q.
struct Ray {
  Vec3 x, q, center, normal;
  bool endless = false;
};
struct Corners {
  Vec3 a, b, c;
};

/// The sign of det(d, a - x, b - x) with the ray's direction d, which is q - x or q: the side on which its
/// line passes the edge ab.
int side_of_edge(const Ray& ray, const Vec3& a, const Vec3& b);

/// The side of x to the plane of a face: the sign of D = det(a - x, b - x, c - x), or 0 where x lies in that
/// plane as far as double can tell.
///
/// That is so where |D| ≤ 4u·S with u = 2^-53 and, in absolute values by component,
///   S = |B × C|·|a| + |C × A|·|b| + |A × B|·|c| + |N|·|x|,   A = a - x, ..., N = A × B + B × C + C × A.
/// The factors are the derivatives of D by its twelve coordinates. So, to first order, these are the points x
/// that some change of all coordinates by four roundings each puts into the plane. A face without area has D
/// = 0.
int side_of_face(const Vec3& x, const Corners& face);

/// Whether the point where the line from x to q meets the plane of the face lies in front of the light's
/// plane; always so for an endless ray. x must lie in front of it, q farther towards it, and the line must
/// not be parallel to the face.
///
/// The line meets the face at t = D/s, with s = (q - x)·N, and the light at T = m·(c - x)/(m·(q - x)). Both
/// are positive here, so t < T is |D|·|m·(q - x)| < |m·(c - x)|·|s|.
bool is_before_light(const Ray& ray, const Corners& face);

}  // namespace penumbra::oracle
