// The cheapest tier of classify_face, for many faces and one light: plain double, and one bound on the error
// from the lengths of vectors instead of a bound that follows the formula.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "volumes/predicates.h"

namespace penumbra::detail {

/// With the face's sides e1 and e2, S = |e1||e2|, w = center - a, R² = max(|w|², r²) and Q² = S² R² (m·m),
/// also where every sum is taken of absolute values: |N_i| ≤ S by Cauchy and Schwarz, so |d| ≤ √3 S |w| and
/// |(N × m)_i| ≤ √2 S |m|, and
///     d²(m·m) + r²|N × m|² ≤ (3 + 6) Q².
/// Evaluated in double the form takes 22 roundings at most (detail/filtered.h counts them), so it is off by
/// less than 23 u 9 Q², u = 2^-53; kBound doubles that and more, for the roundings of Q² itself. In the
/// ranges below nothing overflows, and underflow adds less than a rounding; elsewhere nothing is decided. A
/// form above the bound says that d²(m·m) > 2^-44 Q², so |d| > 2^-22 S R, and its rounding error, below 9 u
/// √3 S |w|, cannot turn its sign.
class QuickClassifier {
 public:
  explicit QuickClassifier(const DiskLight& light)
      : center_(light.center),
        normal_(light.normal),
        radius2_(light.radius * light.radius),
        normal2_(glm::dot(light.normal, light.normal)),
        usable_(within(normal2_, 0x1p-100, 0x1p100)) {}

  std::optional<FaceClass> operator()(const Vec3& a, const Vec3& b, const Vec3& c) const {
    constexpr double kBound = 9 * 0x1p-47;
    const Vec3 e1 = b - a, e2 = c - a, w = center_ - a;
    const Vec3 normal = glm::cross(e1, e2);
    const double d = glm::dot(normal, w);
    const Vec3 across = glm::cross(normal, normal_);
    const double tangency = d * d * normal2_ - radius2_ * glm::dot(across, across);
    const double sides2 = glm::dot(e1, e1) * glm::dot(e2, e2);
    const double reach2 = std::max(glm::dot(w, w), radius2_), q2 = sides2 * (reach2 * normal2_);
    const bool sure = std::abs(tangency) > kBound * q2 && sides2 >= 0x1p-1000 && reach2 >= 0x1p-1000 &&
                      within(q2, 0x1p-900, 0x1p900) && usable_;
    if (!sure) return std::nullopt;
    // Without a branch: which class it is, no processor can foresee.
    const int misses_disk = tangency > 0.0, in_front = d > 0.0;
    return static_cast<FaceClass>(static_cast<int>(FaceClass::kMixed) + misses_disk * (2 * in_front - 1));
  }

 private:
  static bool within(double x, double low, double high) { return x >= low && x <= high; }

  Vec3 center_, normal_;
  double radius2_, normal2_;
  bool usable_;
};

}  // namespace penumbra::detail
