// Exact rationals for oracles, by GMP's own C++ class: nothing here is shared with the library's exact tier.
#pragma once

#include <gmpxx.h>

#include "penumbra/mesh/types.h"
#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::testing {

using Rational = mpq_class;

struct RationalVec {
  Rational x, y, z;
};

inline RationalVec exact(const Vec3& v) {
  return {Rational(v.x), Rational(v.y), Rational(v.z)};
}
inline RationalVec operator-(const RationalVec& a, const RationalVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline RationalVec operator+(const RationalVec& a, const RationalVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline RationalVec operator*(const Rational& s, const RationalVec& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Rational dot(const RationalVec& a, const RationalVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline RationalVec cross(const RationalVec& a, const RationalVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline bool is_zero(const RationalVec& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}
inline Sign sign_of(const Rational& x) {
  return static_cast<Sign>(sgn(x));
}
inline Sign opposite(Sign s) {
  return static_cast<Sign>(-static_cast<int>(s));
}

/// Sign of a + b√d, d ≥ 0.
inline Sign sign_of_root_form(const Rational& a, const Rational& b, const Rational& d) {
  const int sa = sgn(a), sb = d == 0 ? 0 : sgn(b);
  if (sa == 0 || sb == 0 || sa == sb) return static_cast<Sign>(sa != 0 ? sa : sb);
  const Rational difference = a * a - b * b * d;
  return static_cast<Sign>(sgn(difference) * sa);
}

}  // namespace penumbra::testing
