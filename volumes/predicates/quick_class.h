// The cheapest tiers of classify_face, for many faces and one light: plain double, and a bound on the error
// from the lengths of vectors instead of one that follows the formula.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

/// With the face's sides e1 and e2, S ≥ |e1||e2|, w = center - a, R ≥ max(|w|, r) and Q² = S² R² (m·m), also
/// where every sum is taken of absolute values: |N_i| ≤ S by Cauchy and Schwarz, so |d| ≤ √3 S |w| and
/// |(N × m)_i| ≤ √2 S |m|, and
///     d²(m·m) + r²|N × m|² ≤ (3 + 6) Q².
/// Evaluated in double the form takes 22 roundings at most (filtered.h counts them), so it is off by
/// less than 23 u 9 Q², u = 2^-53; kBound doubles that and more, for the roundings of Q² itself. In the
/// ranges below nothing overflows, and underflow adds less than a rounding; elsewhere nothing is decided. A
/// form above the bound says that d²(m·m) > 2^-44 Q², so |d| > 2^-22 S R, and its rounding error, below 9 u
/// √3 S |w|, cannot turn its sign.
/// Of a distant light w = -m and the form is d² - r²|N × m|² ≤ (3 + 6) Q² with R = max(1, r): the same bound
/// holds, and above it |d| > 2^-22 S |w|.
class QuickClassifier {
 public:
  explicit QuickClassifier(const CircularLight& light)
      : center_(light.center),
        normal_(light.normal),
        distant_(light.is_distant()),
        radius2_(light.radius * light.radius),
        normal2_(glm::dot(light.normal, light.normal)),
        measure2_(distant_ ? 1.0 : normal2_) {}

  /// One bound for all faces of a mesh: S is the square of its longest edge, R reaches its farthest corner.
  double bound_of(const TriangleMesh& mesh) const {
    const double side2 = mesh.longest_edge() * mesh.longest_edge();
    if (distant_) return bound(side2 * side2, 1.0);
    const Vec3 w = glm::max(glm::abs(mesh.bounds().low - center_), glm::abs(mesh.bounds().high - center_));
    return bound(side2 * side2, glm::dot(w, w));
  }

  /// Many faces, by plain loops over arrays of coordinates, which compilers turn into vector instructions.
  struct Block {
    static constexpr std::size_t kFaces = 64;
    using Array = std::array<double, kFaces>;
    std::array<Array, 3> a, b, c;  ///< corners: x, y and z
    Array center, tangency;        ///< d, and d²(m·m) - r²|N × m|² (distant: d² - r²|N × m|²)
  };
  void evaluate(Block& f) const {
    const Vec3 center = center_;
    if (distant_)
      evaluate_by(f, [center](const Vec3&) { return center; });
    else
      evaluate_by(f, [center](const Vec3& a) { return center - a; });
  }
  /// Of a face of a block. `bound` is bound_of its mesh.
  static std::optional<FaceClass> class_of(const Block& f, std::size_t i, double bound) {
    return class_of({f.center[i], f.tangency[i]}, bound);
  }

  /// With the face's own bound.
  std::optional<FaceClass> operator()(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 e1 = b - a, e2 = c - a, w = distant_ ? center_ : center_ - a;
    const double distance2 = distant_ ? 1.0 : glm::dot(w, w);
    return class_of(forms_of(e1, e2, w), bound(glm::dot(e1, e1) * glm::dot(e2, e2), distance2));
  }

 private:
  struct Forms {
    double center, tangency;  ///< as of a Block
  };

  /// `way` gives w of a face's first corner.
  template <class Way>
  void evaluate_by(Block& f, Way way) const {
    const QuickClassifier self = *this;
    for (std::size_t i = 0; i < Block::kFaces; ++i) {
      const Vec3 a(f.a[0][i], f.a[1][i], f.a[2][i]);
      const Forms forms = self.forms_of(Vec3(f.b[0][i], f.b[1][i], f.b[2][i]) - a,
                                        Vec3(f.c[0][i], f.c[1][i], f.c[2][i]) - a, way(a));
      f.center[i] = forms.center;
      f.tangency[i] = forms.tangency;
    }
  }

  Forms forms_of(const Vec3& e1, const Vec3& e2, const Vec3& w) const {
    const Vec3 normal = glm::cross(e1, e2);
    const double d = glm::dot(normal, w);
    const Vec3 across = glm::cross(normal, normal_);
    return {d, d * d * measure2_ - radius2_ * glm::dot(across, across)};
  }

  /// Infinite where S², R² or m·m is out of range. `distance2` is |w|², or 1 for a distant light.
  double bound(double sides2, double distance2) const {
    constexpr double kBound = 9 * 0x1p-47;
    const double reach2 = std::max(distance2, radius2_), q2 = sides2 * (reach2 * normal2_);
    const bool usable = sides2 >= 0x1p-1000 && reach2 >= 0x1p-1000 && within(q2, 0x1p-900, 0x1p900) &&
                        within(normal2_, 0x1p-100, 0x1p100);
    return usable ? kBound * q2 : std::numeric_limits<double>::infinity();
  }

  static std::optional<FaceClass> class_of(const Forms& forms, double bound) {
    if (!(std::abs(forms.tangency) > bound)) return std::nullopt;
    // Without a branch: which class it is, no processor can foresee.
    const int misses_disk = forms.tangency > 0.0, in_front = forms.center > 0.0;
    return static_cast<FaceClass>(static_cast<int>(FaceClass::kMixed) + misses_disk * (2 * in_front - 1));
  }

  static bool within(double x, double low, double high) { return x >= low && x <= high; }

  Vec3 center_, normal_;
  bool distant_;
  double radius2_, normal2_, measure2_;
};

}  // namespace penumbra::detail
