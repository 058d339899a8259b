// Plain double with a bound on its error, which the compiler derives: the first tier of predicates.h.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

/// A computed value together with the magnitude of its form (the same form over absolute values). With u =
/// 2^-53 and exact value x, `value` v and exact magnitude M the type promises
///     |x| ≤ M  and  |v - x| ≤ ((1 + u)^Roundings - 1) M.
/// Proof by induction. A double is exact (Roundings 0), a difference of two doubles is rounded once,
/// relatively, also in the subnormal range (1). A sum rounds once more than its worse operand; the same
/// reasoning holds, since addition has no underflow error. A product of (v1, M1), (v2, M2) is off by at most
/// ((1 + u)^(R1 + R2) - 1) M1 M2, then by a factor (1 + u), then, in the subnormal range, by 2^-1075 =
/// u·2^-1022: covered by R1 + R2 + 1 and M = M1 M2 + 2^-1022. Overflow makes the magnitude infinite or NaN,
/// and then no sign is certain.
template <int Roundings>
struct Filtered {
  double value, magnitude;
};

template <int R, int S>
constexpr auto operator+(const Filtered<R>& a, const Filtered<S>& b) {
  return Filtered<std::max(R, S) + 1>{a.value + b.value, a.magnitude + b.magnitude};
}

template <int R, int S>
constexpr auto operator-(const Filtered<R>& a, const Filtered<S>& b) {
  return Filtered<std::max(R, S) + 1>{a.value - b.value, a.magnitude + b.magnitude};
}

template <int R, int S>
constexpr auto operator*(const Filtered<R>& a, const Filtered<S>& b) {
  constexpr double kSmallestNormal = 0x1p-1022;
  return Filtered<R + S + 1>{a.value * b.value, a.magnitude * b.magnitude + kSmallestNormal};
}

struct FilterArithmetic {
  static Filtered<0> value(double x) { return {x, std::abs(x)}; }
  static Filtered<1> difference(double x, double y) { return {x - y, std::abs(x - y)}; }

  /// The magnitude itself is computed with at most 2R roundings (each product adds one sum), so M ≤ (1 -
  /// u)^-2R times what is stored (for a difference: (1 - u)^-1). Hence |v - x| ≤ ((1 + u)^R - 1)(1 - u)^-2R
  /// stored ≤ (R + 1) u stored for R ≤ 1000, and one more u covers the rounding of the product below.
  template <int R>
  static std::optional<Sign> sign(const Filtered<R>& x) {
    static_assert(R <= 1000);
    constexpr double kBound = (R + 2) * 0x1p-53;
    const double error = kBound * x.magnitude;
    if (x.value > error) return Sign::kPositive;
    if (-x.value > error) return Sign::kNegative;
    return std::nullopt;
  }
};

}  // namespace penumbra::detail
