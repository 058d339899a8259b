#include "volumes/solids/shafts/closest_to_origin.h"

#include <glm/geometric.hpp>

namespace penumbra::detail {

bool ClosestToOrigin::add(const Vec3& corner) {
  for (int i = 0; i < count_; ++i)
    if (corners_[i] == corner) return false;
  corners_[count_++] = corner;
  if (count_ == 1) {
    point_ = corner;
  } else if (count_ == 2) {
    closest_on_segment();
  } else if (count_ == 3) {
    closest_on_triangle();
  } else {
    return closest_on_tetrahedron();
  }
  return true;
}

void ClosestToOrigin::closest_on_segment() {
  const Vec3 a = corners_[0], b = corners_[1], ab = b - a;
  const double t = -glm::dot(a, ab), whole = glm::dot(ab, ab);
  if (t <= 0.0) {
    count_ = 1;
    point_ = a;
  } else if (t >= whole) {
    corners_[0] = b;
    count_ = 1;
    point_ = b;
  } else {
    point_ = a + (t / whole) * ab;
  }
}

/// By the regions of corners and sides; C. Ericson, "Real-time collision detection" (2005), section 5.1.5.
void ClosestToOrigin::closest_on_triangle() {
  const Vec3 a = corners_[0], b = corners_[1], c = corners_[2];
  const Vec3 ab = b - a, ac = c - a;
  const auto keep = [&](const Vec3& p, const Vec3& q) {
    corners_[0] = p;
    corners_[1] = q;
    count_ = 2;
    closest_on_segment();
  };
  const double d1 = -glm::dot(ab, a), d2 = -glm::dot(ac, a);
  const double d3 = -glm::dot(ab, b), d4 = -glm::dot(ac, b);
  const double d5 = -glm::dot(ab, c), d6 = -glm::dot(ac, c);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return keep(a, b);
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return keep(a, c);
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return keep(b, c);
  const double sum = va + vb + vc;
  if (va > 0.0 && vb > 0.0 && vc > 0.0 && sum > 0.0) {
    point_ = a + (vb / sum) * ab + (vc / sum) * ac;
    return;
  }
  // A corner, or no area: the best of the sides.
  ClosestToOrigin best;
  for (const auto& [p, q] : {std::pair{a, b}, std::pair{a, c}, std::pair{b, c}}) {
    ClosestToOrigin side;
    side.add(p);
    side.add(q);
    if (best.count_ == 0 || glm::dot(side.point_, side.point_) < glm::dot(best.point_, best.point_))
      best = side;
  }
  *this = best;
}

bool ClosestToOrigin::closest_on_tetrahedron() {
  const std::array<Vec3, 4> p = corners_;
  ClosestToOrigin best;
  bool inside = true;
  constexpr int kFaces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  for (const auto& f : kFaces) {
    const Vec3 normal = glm::cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]);
    const double here = -glm::dot(normal, p[f[0]]), opposite = glm::dot(normal, p[f[3]] - p[f[0]]);
    if (here * opposite > 0.0) continue;  // the origin is on the inner side
    inside = false;
    ClosestToOrigin face;
    for (int i = 0; i < 3; ++i) face.corners_[i] = p[f[i]];
    face.count_ = 3;
    face.closest_on_triangle();
    if (best.count_ == 0 || glm::dot(face.point_, face.point_) < glm::dot(best.point_, best.point_))
      best = face;
  }
  if (inside) return false;
  *this = best;
  return true;
}

}  // namespace penumbra::detail
