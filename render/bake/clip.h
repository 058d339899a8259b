// Bake: convex polygons of the texture, cut by lines.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>

#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra::detail {

inline double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}
/// Twice the area of the triangle, positive where it turns from x to y.
inline double doubled_area(const FaceUv& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}

/// A triangle after up to eight cuts.
class ConvexPolygon {
 public:
  ConvexPolygon() = default;
  explicit ConvexPolygon(const FaceUv& t) : corners_{t[0], t[1], t[2]}, count_(3) {}

  bool empty() const { return count_ < 3; }
  /// What is left where `side(point)`, a linear function, is at least 0.
  template <class Side>
  ConvexPolygon cut(const Side& side) const {
    ConvexPolygon out;
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::dvec2 &p = corners_[i], &q = corners_[(i + 1) % count_];
      const double a = side(p), b = side(q);
      if (a >= 0.0) out.push(p);
      if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) out.push(p + (q - p) * (a / (a - b)));
    }
    return out;
  }

  struct AreaAndCentroid {
    double area = 0.0;
    glm::dvec2 centroid{0.0};
  };
  /// The area is not negative, whichever way the polygon turns. Without area the centroid is the first
  /// corner.
  AreaAndCentroid measure() const {
    if (empty()) return {};
    double area = 0.0;
    glm::dvec2 moment(0.0);
    for (std::size_t i = 2; i < count_; ++i) {
      const glm::dvec2 u = corners_[i - 1] - corners_[0], v = corners_[i] - corners_[0];
      const double part = cross(u, v);
      area += part;
      moment += part / 3.0 * (u + v);
    }
    return {0.5 * std::abs(area), area != 0.0 ? corners_[0] + moment / area : corners_[0]};
  }

 private:
  void push(const glm::dvec2& p) {
    if (count_ < corners_.size()) corners_[count_++] = p;
  }

  std::array<glm::dvec2, 12> corners_{};
  std::size_t count_ = 0;
};

/// The box of a face in the texture.
struct UvBox {
  explicit UvBox(const FaceUv& t) {
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min({t[0][k], t[1][k], t[2][k]});
      high[k] = std::max({t[0][k], t[1][k], t[2][k]});
    }
  }
  glm::dvec2 low, high;
};

}  // namespace penumbra::detail
