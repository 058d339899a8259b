#include "volumes/solids/simplify/triangle_conflict.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {
namespace {

using Corners = std::array<Vec3, 3>;

/// A segment that does not lie in the triangle's plane meets the triangle.
bool meets(const Vec3& from, const Vec3& to, const Corners& t) {
  const Sign before = orient3d(t[0], t[1], t[2], from), after = orient3d(t[0], t[1], t[2], to);
  if (before == after) return false;  // strictly on one side, or in the plane: then some other segment tells
  bool positive = false, negative = false;
  for (int k = 0; k < 3; ++k) {
    const Sign side = orient3d(from, to, t[k], t[(k + 1) % 3]);
    positive = positive || side == Sign::kPositive;
    negative = negative || side == Sign::kNegative;
  }
  return !(positive && negative);
}

/// In a plane across an axis, as caps are.
bool are_in_one_level(const Corners& p, const Corners& q) {
  for (int k = 0; k < 3; ++k) {
    const auto equal = [&](const Vec3& x) { return x[k] == p[0][k]; };
    if (std::ranges::all_of(p, equal) && std::ranges::all_of(q, equal)) return true;
  }
  return false;
}

/// Where the corners of q lie that are not corners of p, against the plane of p.
struct Sides {
  int above = 0, below = 0, own = 0;
  Sides(const Corners& p, const Corners& q, const bool (&shared)[3]) {
    for (int i = 0; i < 3; ++i) {
      if (shared[i]) continue;
      const Sign side = orient3d(p[0], p[1], p[2], q[i]);
      above += side == Sign::kPositive ? 1 : 0;
      below += side == Sign::kNegative ? 1 : 0;
      ++own;
    }
  }
  bool are_one() const { return above == own || below == own; }
  bool are_in_plane() const { return above + below == 0; }
};

/// In one plane: no side of either has the other triangle beyond it.
bool overlap_in_plane(const Corners& p, const Corners& q) {
  const Vec3 n = glm::abs(glm::cross(p[1] - p[0], p[2] - p[0]));
  const int drop = n.x >= n.y && n.x >= n.z ? 0 : (n.y >= n.z ? 1 : 2);
  const auto flat = [&](const Vec3& x) { return glm::dvec2(x[(drop + 1) % 3], x[(drop + 2) % 3]); };
  const auto separates = [&](const Corners& s, const Corners& t) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec2 a = flat(s[k]), ab = flat(s[(k + 1) % 3]) - a, own = flat(s[(k + 2) % 3]) - a;
      const double side = ab.x * own.y - ab.y * own.x;
      bool beyond = true;
      for (const Vec3& x : t) {
        const glm::dvec2 d = flat(x) - a;
        beyond = beyond && (ab.x * d.y - ab.y * d.x) * side <= 0.0;
      }
      if (beyond) return true;
    }
    return false;
  };
  return !separates(p, q) && !separates(q, p);
}

}  // namespace

bool are_in_conflict(const Corners& p, const IndexedTriangle& a, const Corners& q, const IndexedTriangle& b) {
  int shared = 0, own_b = 0, shared_a = 0, shared_b = 0;
  bool is_shared_a[3]{}, is_shared_b[3]{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a[i] == b[j]) {
        ++shared;
        is_shared_a[i] = is_shared_b[j] = true;
        shared_a = i;
        shared_b = j;
      }
  for (int i = 0; i < 3; ++i)
    if (!is_shared_b[i]) own_b = i;
  if (shared == 3) return true;
  if (shared == 2) {  // folded onto each other?
    const double facing =
        glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), glm::cross(q[1] - q[0], q[2] - q[0]));
    return facing <= 0.0 && orient3d(p[0], p[1], p[2], q[own_b]) == Sign::kZero;
  }
  if (are_in_one_level(p, q)) return overlap_in_plane(p, q);
  const Sides of_q(p, q, is_shared_b);
  if (of_q.are_one()) return false;
  if (of_q.are_in_plane()) return overlap_in_plane(p, q);
  if (Sides(q, p, is_shared_a).are_one()) return false;
  if (shared == 1)
    return meets(p[(shared_a + 1) % 3], p[(shared_a + 2) % 3], q) ||
           meets(q[(shared_b + 1) % 3], q[(shared_b + 2) % 3], p);
  for (int k = 0; k < 3; ++k)
    if (meets(p[k], p[(k + 1) % 3], q) || meets(q[k], q[(k + 1) % 3], p)) return true;
  return false;
}

}  // namespace penumbra::detail
