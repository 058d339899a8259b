#include "volumes/cells/triangle_contact.h"

#include <algorithm>
#include <cmath>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

namespace {

using Signs = std::array<Sign, 3>;

bool any(std::span<const Sign> signs, Sign sign) {
  return std::find(signs.begin(), signs.end(), sign) != signs.end();
}

/// Points of the line pq: all lie beyond the same end of the segment.
bool are_off_segment(const Vec3& p, const Vec3& q, std::span<const Vec3> points) {
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax(p[k], q[k]);
    if (std::all_of(points.begin(), points.end(), [&](const Vec3& x) { return x[k] < low; })) return true;
    if (std::all_of(points.begin(), points.end(), [&](const Vec3& x) { return x[k] > high; })) return true;
  }
  return false;
}

/// What lies in the plane of one triangle.
class InPlane {
 public:
  /// `valid` is false for a triangle without area.
  explicit InPlane(const Corners& t) {
    for (int k = 0; k < 3 && !valid; ++k) {
      off_ = t[0];
      off_[k] = off_[k] != 0.0 ? -off_[k] : 1.0;
      valid = orient3d(t[0], t[1], t[2], off_) != Sign::kZero;
    }
  }
  bool valid = false;

  /// A side of a convex polygon, `inner` being another of its corners, has all of `others` beyond its line,
  /// or on the line but beyond one end of the side.
  bool separates(const Vec3& p, const Vec3& q, const Vec3& inner, std::span<const Vec3> others) const {
    const Sign inside = side(p, q, inner);
    return inside != Sign::kZero && are_beyond(p, q, inside, others);
  }
  /// The same of a segment: whatever side it is.
  bool separates(const Vec3& p, const Vec3& q, std::span<const Vec3> others) const {
    return are_beyond(p, q, Sign::kPositive, others) || are_beyond(p, q, Sign::kNegative, others);
  }

 private:
  Sign side(const Vec3& p, const Vec3& q, const Vec3& x) const { return orient3d(p, q, off_, x); }
  bool are_beyond(const Vec3& p, const Vec3& q, Sign inside, std::span<const Vec3> others) const {
    std::array<Vec3, 3> on_line;
    std::size_t count = 0;
    for (const Vec3& x : others) {
      const Sign s = side(p, q, x);
      if (s == inside) return false;
      if (s == Sign::kZero) on_line[count++] = x;
    }
    return count == 0 || are_off_segment(p, q, std::span(on_line).first(count));
  }

  Vec3 off_{0.0};
};

bool do_meet_in_plane(const Vec3& p, const Vec3& q, const Corners& t) {
  const InPlane plane(t);
  if (!plane.valid || p == q) return true;
  const std::array<Vec3, 2> segment{p, q};
  for (int i = 0; i < 3; ++i)
    if (plane.separates(t[i], t[(i + 1) % 3], t[(i + 2) % 3], segment)) return false;
  return !plane.separates(p, q, t);
}

Signs sides_of_line(const Vec3& p, const Vec3& q, const Corners& t) {
  return {orient3d(p, q, t[0], t[1]), orient3d(p, q, t[1], t[2]), orient3d(p, q, t[2], t[0])};
}

/// Of the segment pq, whose ends are on these sides of the triangle's plane.
bool segment_meets(const Vec3& p, Sign side_p, const Vec3& q, Sign side_q, const Corners& t) {
  if (side_p == Sign::kZero && side_q == Sign::kZero) return do_meet_in_plane(p, q, t);
  if (side_p == side_q) return false;
  const Signs sides = sides_of_line(p, q, t);
  return !(any(sides, Sign::kPositive) && any(sides, Sign::kNegative));
}

Sign side_of(const Corners& t, const Vec3& x) {
  return orient3d(t[0], t[1], t[2], x);
}

/// Turns both so that the corners that they share come first, in the same order; returns how many there are.
int align(Corners& a, Corners& b) {
  int shared = 0;
  for (int i = 0; i < 3; ++i) {
    const auto at = std::find(b.begin() + shared, b.end(), a[i]);
    if (at == b.end()) continue;
    std::swap(a[shared], a[i]);
    std::iter_swap(b.begin() + shared, at);
    ++shared;
  }
  return shared;
}

/// Beyond a shared side: only in one plane, on the same side of it.
bool do_meet_beyond_side(const Corners& a, const Corners& b) {
  if (side_of(a, b[2]) != Sign::kZero) return false;
  const InPlane plane(a);
  return !plane.valid || !plane.separates(a[0], a[1], a[2], std::span(&b[2], 1));
}

/// Two triangles meet iff a side of one meets the other. Where they share a corner and another point, the
/// segment between the two leaves one of them through the side opposite to the corner.
bool sides_meet(const Corners& a, const Signs& sides_of_a, const Corners& b, int shared) {
  for (int i = shared; i < 3; ++i) {
    const int j = i + 1 < 3 ? i + 1 : shared == 0 ? 0 : -1;
    if (j >= 0 && segment_meets(a[i], sides_of_a[i], a[j], sides_of_a[j], b)) return true;
  }
  return false;
}

bool are_on_one_side(const Signs& sides, int shared) {
  const std::span<const Sign> own = std::span(sides).subspan(static_cast<std::size_t>(shared));
  return own.front() != Sign::kZero &&
         std::all_of(own.begin(), own.end(), [&](Sign s) { return s == own.front(); });
}

Signs sides_of_corners(const Corners& a, const Corners& plane, int shared) {
  Signs sides{Sign::kZero, Sign::kZero, Sign::kZero};
  for (int i = shared; i < 3; ++i) sides[i] = side_of(plane, a[i]);
  return sides;
}

}  // namespace

bool do_meet(const Corners& first, const Corners& second) {
  Corners a = first, b = second;
  const int shared = align(a, b);
  if (shared == 3) return true;
  if (shared == 2) return do_meet_beyond_side(a, b);
  const Signs sides_of_b = sides_of_corners(b, a, shared);
  if (are_on_one_side(sides_of_b, shared)) return false;
  const bool in_one_plane = !any(sides_of_b, Sign::kPositive) && !any(sides_of_b, Sign::kNegative);
  const Signs sides_of_a = in_one_plane ? sides_of_b : sides_of_corners(a, b, shared);
  if (are_on_one_side(sides_of_a, shared)) return false;
  return sides_meet(a, sides_of_a, b, shared) || sides_meet(b, sides_of_b, a, shared);
}

std::optional<int> crossing(const Vec3& x, const Vec3& y, const Corners& t) {
  const Sign at_x = side_of(t, x), at_y = side_of(t, y);
  if (at_x == at_y && at_x != Sign::kZero) return 0;
  const Signs sides = sides_of_line(x, y, t);
  if (any(sides, Sign::kPositive) && any(sides, Sign::kNegative)) return 0;
  if (any(sides, Sign::kZero) || at_x == Sign::kZero || at_y == Sign::kZero) return std::nullopt;
  return at_y == Sign::kPositive ? 1 : -1;
}

}  // namespace penumbra::detail
