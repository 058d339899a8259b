// What the predicates have to answer, in rationals: nothing here is shared with the library.
//
// w leads from a to the light's center; of a distant light it is the direction -m, and its rim is -m + r|m|e
// with unit vectors e perpendicular to m.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "tests/volumes/predicates/rational.h"
#include "tests/volumes/random_inputs.h"

namespace penumbra::testing {

inline RationalVec way_oracle(const CircularLight& light, const RationalVec& a) {
  return light.is_distant() ? Rational(-1) * exact(light.normal) : exact(light.center) - a;
}

/// The square of the rim's distance from the end of w.
inline Rational rim_oracle(const CircularLight& light) {
  const Rational r = light.radius;
  const RationalVec m = exact(light.normal);
  return light.is_distant() ? Rational(r * r * dot(m, m)) : Rational(r * r);
}

inline FaceClass classify_oracle(const PredicateInput& in) {
  const RationalVec a = exact(in.p[0]), m = exact(in.light.normal);
  const RationalVec n = cross(exact(in.p[1]) - a, exact(in.p[2]) - a);
  const Rational d = dot(n, way_oracle(in.light, a)), nn = dot(n, n), nm = dot(n, m), mm = dot(m, m);
  const Rational extent = rim_oracle(in.light) * (nn * mm - nm * nm);  // |N × m|² by Lagrange
  if (!(d * d * mm > extent)) return FaceClass::kMixed;
  return d > 0 ? FaceClass::kAllFront : FaceClass::kNoneFront;
}

inline Sign line_oracle(const PredicateInput& in) {
  const RationalVec a = exact(in.p[0]), e = exact(in.p[1]) - a, w = way_oracle(in.light, a);
  const RationalVec m = exact(in.light.normal);
  const Rational rr = rim_oracle(in.light), slope = dot(m, e), height = dot(m, w);
  if (slope != 0) {
    const RationalVec offset = Rational(height / slope) * e - w;
    return sign_of(dot(offset, offset) - rr);
  }
  if (height != 0) return Sign::kPositive;
  const RationalVec moment = cross(e, w);
  return sign_of(dot(moment, moment) - rr * dot(e, e));
}

/// Side of a tangent plane from the plane itself: its normal is a root of a quadratic form, and a linear
/// function of it has the form A ± B√D. Returns nothing for the cases that the header reads as limits.
inline std::optional<Sign> tangent_oracle(const PredicateInput& in, Tangent which) {
  const RationalVec a = exact(in.p[0]), e = exact(in.p[1]) - a, w = way_oracle(in.light, a);
  const RationalVec m = exact(in.light.normal);
  const Rational rr = rim_oracle(in.light), mm = dot(m, m);
  if (rr == 0 || (dot(e, m) == 0 && dot(w, m) == 0)) return std::nullopt;
  const RationalVec axis = e.x != 0 ? RationalVec{0, 1, 0} : RationalVec{1, 0, 0};
  const RationalVec u1 = cross(e, axis), u2 = cross(e, u1);
  const RationalVec m1 = cross(m, u1), m2 = cross(m, u2);
  const Rational w1 = dot(u1, w), w2 = dot(u2, w);
  const Rational q00 = w1 * w1 * mm - rr * dot(m1, m1), q01 = w1 * w2 * mm - rr * dot(m1, m2),
                 q11 = w2 * w2 * mm - rr * dot(m2, m2), disc = q01 * q01 - q00 * q11;
  const auto project = [&](const RationalVec& n) { return mm * n - Rational(dot(n, m)) * m; };
  for (const int root : {1, -1}) {
    // n = alpha u1 + beta u2 = fixed + root √disc · varying
    RationalVec fixed, varying{0, 0, 0};
    if (q00 != 0) {
      fixed = Rational(-q01) * u1 + q00 * u2;
      varying = Rational(root) * u1;
    } else {
      fixed = root == 1 ? u1 : q11 * u1 - Rational(2 * q01) * u2;
    }
    const auto linear = [&](const RationalVec& v) {
      return sign_of_root_form(dot(fixed, v), dot(varying, v), disc);
    };
    const bool flipped = linear(w) == Sign::kNegative;  // the disk is to be on the positive side
    // contact - center = -n⊥ times something positive; orient3d(a, b, contact, center) = e·((contact -
    // center) × w).
    const RationalVec pf = project(fixed), pv = project(varying), ew = cross(w, e);
    Sign turn = sign_of_root_form(-dot(pf, ew), -dot(pv, ew), disc);
    if (flipped) turn = opposite(turn);
    if (turn != (which == Tangent::kFirst ? Sign::kPositive : Sign::kNegative)) continue;
    const Sign side = linear(exact(in.p[2]) - a);
    return flipped ? opposite(side) : side;
  }
  ADD_FAILURE() << "no tangent plane of that name";
  return std::nullopt;
}

}  // namespace penumbra::testing
