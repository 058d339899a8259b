// Whether any of the light is hidden from a point, triangle by triangle, with nothing of the library's
// volumes in it.
//
// The rays from x through a triangle form a cone, the intersection of the half-spaces n·(p - x) ≥ 0 of its
// side planes. Where it meets the light's plane it is a convex region R; the triangle hides a positive area
// of the disk iff R has an interior and its distance from the center is below the radius. The closest point
// of R is the center, the foot of the perpendicular on one of its lines, or a corner where two meet: all
// rational. Of a distant light the plane is that of the directions d with d·m = -m·m, its center -m and its
// radius r|m|.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "penumbra/volumes/disk_light.h"
#include "tests/volumes/predicates/rational.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra::testing {

/// The oracle's arithmetic in doubles, or exact.
template <class Number>
struct Vector {
  Number x, y, z;
};
template <class N>
Vector<N> minus(const Vector<N>& a, const Vector<N>& b) {
  return {N(a.x - b.x), N(a.y - b.y), N(a.z - b.z)};
}
template <class N>
Vector<N> plus(const Vector<N>& a, const N& s, const Vector<N>& b) {
  return {N(a.x + s * b.x), N(a.y + s * b.y), N(a.z + s * b.z)};
}
template <class N>
N inner(const Vector<N>& a, const Vector<N>& b) {
  return N(a.x * b.x + a.y * b.y + a.z * b.z);
}
template <class N>
Vector<N> outer(const Vector<N>& a, const Vector<N>& b) {
  return {N(a.y * b.z - a.z * b.y), N(a.z * b.x - a.x * b.z), N(a.x * b.y - a.y * b.x)};
}
template <class N>
Vector<N> vector_of(const Vec3& v) {
  return {N(v.x), N(v.y), N(v.z)};
}

enum class Answer { kNo, kYes, kUnsure };

/// Does the triangle hide a positive area of the disk from x? `slack` 0 asks for exact arithmetic; else
/// comparisons closer than it (relative to the quantities compared) are unsure.
template <class N>
Answer triangle_hides(const Vec3& at, const std::array<Vec3, 3>& triangle, const CircularLight& light,
                      double slack) {
  const Vector<N> x = vector_of<N>(at), c = vector_of<N>(light.center), m = vector_of<N>(light.normal);
  const N mm = inner(m, m);
  const Vector<N> to_center = light.is_distant() ? minus(Vector<N>{N(0), N(0), N(0)}, m) : minus(c, x);
  const N depth_x = -inner(m, to_center);
  bool unsure = false;
  const auto sign = [&](const N& v, const N& scale) {
    if (slack > 0 && !(v > scale * slack || -v > scale * slack)) {
      unsure = true;
      return 0;
    }
    return v > 0 ? 1 : v < 0 ? -1 : 0;
  };

  // 1. The part of the triangle in front of the light. One in the light's plane has none.
  std::vector<Vector<N>> polygon;
  bool in_front = false;
  for (int i = 0; i < 3; ++i) {
    if (light.is_distant()) {
      polygon.push_back(vector_of<N>(triangle[i]));
      in_front = true;
      continue;
    }
    const Vector<N> p = vector_of<N>(triangle[i]), q = vector_of<N>(triangle[(i + 1) % 3]);
    const N dp = inner(m, minus(p, c)), dq = inner(m, minus(q, c));
    const int sp = sign(dp, depth_x), sq = sign(dq, depth_x);
    if (sp >= 0) polygon.push_back(p);
    in_front = in_front || sp > 0;
    if (sp * sq < 0) polygon.push_back(plus(p, N(dp / (dp - dq)), minus(q, p)));
  }
  if (unsure) return Answer::kUnsure;
  if (!in_front || polygon.size() < 3) return Answer::kNo;

  // 2. Side planes of the cone, turned inward. In the triangle's own plane nothing is hidden.
  const Vector<N> side1 = minus(polygon[1], polygon[0]), side2 = minus(polygon[2], polygon[0]);
  const Vector<N> normal = outer(side1, side2);
  // Of a sliver doubles know no normal.
  sign(inner(normal, normal), N(inner(side1, side1) * inner(side2, side2)));
  const Vector<N> to_x = minus(x, polygon[0]);
  const N height = inner(normal, to_x);
  const int side = sign(height * height, N(inner(normal, normal) * inner(to_x, to_x)));
  if (unsure) return Answer::kUnsure;
  if (side == 0) return Answer::kNo;
  bool nearer_than_x = light.is_distant();
  std::vector<Vector<N>> planes;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector<N> n = outer(minus(polygon[i], x), minus(polygon[(i + 1) % polygon.size()], x));
    planes.push_back(height > 0 ? minus(Vector<N>{N(0), N(0), N(0)}, n) : n);
    if (!light.is_distant() && sign(N(depth_x - inner(m, minus(polygon[i], c))), depth_x) > 0)
      nearer_than_x = true;
  }
  if (unsure) return Answer::kUnsure;
  if (!nearer_than_x) return Answer::kNo;

  // 3. The candidates for the point of R that is closest to the center, by the ways from x to them.
  const N radius2 = N(light.radius) * N(light.radius) * (light.is_distant() ? mm : N(1));
  const auto reaches = [&](const Vector<N>& ray, std::size_t skip1, std::size_t skip2) {
    const Vector<N> offset = minus(ray, to_center);
    if (sign(N(radius2 - inner(offset, offset)), radius2) <= 0) return false;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      if (k == skip1 || k == skip2) continue;
      const N value = inner(planes[k], ray);
      const N scale = inner(planes[k], planes[k]) * inner(ray, ray);
      if (slack > 0 && !(value * value > scale * N(slack))) {
        unsure = true;
        return false;
      }
      if (value < 0) return false;
    }
    return true;
  };
  const std::size_t none = planes.size();
  bool hides = reaches(to_center, none, none);
  for (std::size_t i = 0; i < planes.size() && !hides; ++i) {
    const Vector<N> in_plane = plus(planes[i], N(-inner(planes[i], m) / mm), m);
    const N length2 = inner(in_plane, in_plane);
    if (!(length2 > 0)) continue;  // parallel to the light: no line in its plane
    hides = reaches(plus(to_center, N(-inner(planes[i], to_center) / length2), in_plane), i, none);
    for (std::size_t j = i + 1; j < planes.size() && !hides; ++j) {
      const Vector<N> line = outer(planes[i], planes[j]);
      sign(inner(line, line), N(inner(planes[i], planes[i]) * inner(planes[j], planes[j])));
      if (unsure) return Answer::kUnsure;
      const N slope = inner(m, line);
      if (!(slope > 0 || slope < 0)) continue;
      hides = reaches(plus(Vector<N>{N(0), N(0), N(0)}, N(-depth_x / slope), line), i, j);
    }
  }
  if (hides) return Answer::kYes;
  return unsure ? Answer::kUnsure : Answer::kNo;
}

/// O(x) < 1, exactly: some triangle hides a positive area. x in front of the light, radius above 0.
class ShadowOracle {
 public:
  ShadowOracle(const TriangleMesh& mesh, const CircularLight& light)
      : tree_(mesh.positions(), mesh.triangles()),
        light_(light),
        unit_normal_(light.normal / std::sqrt(glm::dot(light.normal, light.normal))) {}

  bool is_partly_hidden(const Vec3& x) {
    return tree_.find([&](const Bounds& box) { return may_hide(x, box); },
                      [&](std::uint32_t i) { return hides(x, i); });
  }
  std::size_t exact_decisions() const { return exact_decisions_; }

 private:
  /// A point of the cone from x to the disk is x + t(p - x): at most t·radius from the segment from x to the
  /// center.
  bool may_hide(const Vec3& x, const Bounds& box) const {
    if (light_.is_distant()) {
      const Vec3 d = box.center() - x;
      const double size = box.radius() * (1.0 + 1e-9) + 1e-12, t = size - glm::dot(unit_normal_, d);
      return t >= 0.0 &&
             glm::length(glm::cross(d, unit_normal_)) <= size + t * light_.radius * (1.0 + 1e-9) + 1e-12;
    }
    const Vec3 b = box.center(), axis = light_.center - x;
    const double ball = box.radius() * (1.0 + 1e-9) + 1e-12,
                 depth = glm::dot(unit_normal_, x - light_.center);
    const double t_most = std::min(1.0, (glm::dot(unit_normal_, x - b) + ball) / depth);
    if (t_most < 0.0) return false;
    const double t = std::clamp(glm::dot(b - x, axis) / glm::dot(axis, axis), 0.0, 1.0);
    return glm::length(b - x - t * axis) <= ball + t_most * light_.radius * (1.0 + 1e-9) + 1e-12;
  }

  bool hides(const Vec3& x, std::uint32_t i) {
    constexpr double kSlack = 1e-10;
    const std::array<Vec3, 3> t{tree_.corner(i, 0), tree_.corner(i, 1), tree_.corner(i, 2)};
    const Answer quick = triangle_hides<double>(x, t, light_, kSlack);
    if (quick != Answer::kUnsure) return quick == Answer::kYes;
    ++exact_decisions_;
    return triangle_hides<Rational>(x, t, light_, 0.0) == Answer::kYes;
  }

  TriangleTree tree_;
  CircularLight light_;
  Vec3 unit_normal_;
  std::size_t exact_decisions_ = 0;
};

}  // namespace penumbra::testing
