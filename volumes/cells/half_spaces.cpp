#include "volumes/cells/half_spaces.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>
#include <CGAL/determinant.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "volumes/cells/quickhull.h"
#include "volumes/predicates/predicate_forms.h"

namespace penumbra::detail {

namespace {

using Interval = CGAL::Interval_nt<false>;  // "false": the rounding mode is set once a predicate
using RoundUpwards = CGAL::Protect_FPU_rounding<true>;
#ifdef CGAL_HAS_MPZF
using Exact = CGAL::Mpzf;  // sums and products alone: no divisors are sought, unlike in fractions
#else
using Exact = CGAL::Gmpq;
#endif

/// n·y ≤ d with d > 0, y being four times the way from the inside point: dual to the point n/d.
struct Plane {
  std::array<Exact, 4> exact;  ///< n, then d
  std::array<Interval, 4> bounds;
  Vec3 dual;  ///< rounded
};

Triple<Exact> exact(const Vec3& p) {
  return {Exact(p.x), Exact(p.y), Exact(p.z)};
}

double rounded_quotient(const Exact& numerator, const Exact& denominator) {
  return CGAL::to_double(CGAL::Gmpq(numerator) / CGAL::Gmpq(denominator));
}

/// The rows' determinant. With rows (n, d) and all d positive its sign is that of the dual points' rows
/// (n/d, 1), which is the opposite of their orient3d.
template <class T>
T determinant(const std::array<T, 4>& a, const std::array<T, 4>& b, const std::array<T, 4>& c,
              const std::array<T, 4>& d) {
  return CGAL::determinant(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], c[0], c[1], c[2], c[3], d[0], d[1],
                           d[2], d[3]);
}

/// The dual points as Quickhull wants them.
class DualPoints {
 public:
  /// False where the inside point is not strictly below.
  bool add(const HalfSpace& h, const Triple<Exact>& four_origins) {
    const Triple<Exact> a = exact(h[0]);
    const auto normal = cross(differences(h[1], a), differences(h[2], a));
    const Exact four(4);
    const Triple<Exact> way{four * a.x - four_origins.x, four * a.y - four_origins.y,
                            four * a.z - four_origins.z};
    const Exact offset = dot(normal, way);
    if (CGAL::sign(offset) != CGAL::POSITIVE) return false;
    Plane plane{.exact = {normal.x, normal.y, normal.z, offset}, .bounds = {}, .dual = {}};
    std::transform(plane.exact.begin(), plane.exact.end(), plane.bounds.begin(),
                   [](const Exact& x) { return Interval(CGAL::to_interval(x)); });
    for (int k = 0; k < 3; ++k) plane.dual[k] = rounded_quotient(plane.exact[k], offset);
    planes_.push_back(std::move(plane));
    return true;
  }

  const Plane& plane(std::uint32_t i) const { return planes_[i]; }

  int count() const { return static_cast<int>(planes_.size()); }
  const Vec3& rounded(int i) const { return planes_[i].dual; }
  Sign orient3d(int a, int b, int c, int d) const {
    const Plane &p = planes_[a], &q = planes_[b], &r = planes_[c], &s = planes_[d];
    const auto opposite = [](CGAL::Sign sign) { return static_cast<Sign>(-static_cast<int>(sign)); };
    {
      const RoundUpwards protect;
      const auto sign = CGAL::sign(determinant(p.bounds, q.bounds, r.bounds, s.bounds));
      if (sign.is_certain()) return opposite(sign.make_certain());
    }
    return opposite(CGAL::sign(determinant(p.exact, q.exact, r.exact, s.exact)));
  }
  /// Rows of rank 2 at most: every minor of three columns vanishes.
  bool collinear(int a, int b, int c) const {
    const auto &p = planes_[a].exact, &q = planes_[b].exact, &r = planes_[c].exact;
    for (int left_out = 0; left_out < 4; ++left_out) {
      const int i = left_out == 0, j = left_out <= 1 ? 2 : 1, k = left_out == 3 ? 2 : 3;
      if (!CGAL::is_zero(CGAL::determinant(p[i], p[j], p[k], q[i], q[j], q[k], r[i], r[j], r[k])))
        return false;
    }
    return true;
  }

 private:
  static Triple<Exact> differences(const Vec3& p, const Triple<Exact>& a) {
    return {Exact(p.x) - a.x, Exact(p.y) - a.y, Exact(p.z) - a.z};
  }

  std::vector<Plane> planes_;
};

/// About the inside point a plane n·y = d is dual to the point n/d: the convex hull of the dual points has a
/// vertex for each plane that bounds the intersection, and a facet for each corner of it.
class DualHull {
 public:
  HalfSpaceCell run(std::span<const HalfSpace> half_spaces, const std::array<Vec3, 4>& inside) {
    for (const Vec3& p : inside) {
      const Triple<Exact> x = exact(p);
      four_origins_ = {four_origins_.x + x.x, four_origins_.y + x.y, four_origins_.z + x.z};
    }
    for (const HalfSpace& h : half_spaces)
      if (!points_.add(h, four_origins_)) return {};
    facets_ = Quickhull(points_).run();
    number_corners();
    link();
    for (std::uint32_t v = 0; v < half_spaces.size(); ++v)
      if (const auto first = around_.lower_bound({v, 0}); first != around_.end() && first->first[0] == v)
        add_facet(v, first->second);
    return std::move(cell_);
  }

 private:
  /// Where three planes meet, by Cramer's rule.
  Vec3 corner(const IndexedTriangle& t) const {
    const auto &p = points_.plane(t[0]).exact, &q = points_.plane(t[1]).exact, &r = points_.plane(t[2]).exact;
    const Triple<Exact> n[3] = {{p[0], p[1], p[2]}, {q[0], q[1], q[2]}, {r[0], r[1], r[2]}};
    const auto qr = cross(n[1], n[2]), rp = cross(n[2], n[0]), pq = cross(n[0], n[1]);
    const Exact whole = dot(n[0], qr), four_wholes = Exact(4) * whole;
    const auto coordinate = [&](const Exact& origin, const Exact& x, const Exact& y, const Exact& z) {
      return rounded_quotient(origin * whole + p[3] * x + q[3] * y + r[3] * z, four_wholes);
    };
    return {coordinate(four_origins_.x, qr.x, rp.x, pq.x), coordinate(four_origins_.y, qr.y, rp.y, pq.y),
            coordinate(four_origins_.z, qr.z, rp.z, pq.z)};
  }

  /// Facets of one corner's plane, and corners that round to the same doubles, are one corner.
  void number_corners() {
    const auto less = [](const Vec3& a, const Vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<Vec3, std::uint32_t, decltype(less)> numbers(less);
    for (const IndexedTriangle& t : facets_) {
      const Vec3 x = corner(t);
      const auto [at, is_new] = numbers.try_emplace(x, static_cast<std::uint32_t>(cell_.positions.size()));
      if (is_new) cell_.positions.push_back(x);
      number_.push_back(at->second);
    }
  }

  /// By side of the dual hull, from one plane to the next, the facet to its left.
  void link() {
    for (std::uint32_t f = 0; f < facets_.size(); ++f)
      for (int k = 0; k < 3; ++k) around_[{facets_[f][k], facets_[f][(k + 1) % 3]}] = f;
  }

  /// The corners around a plane, counter-clockwise, as a fan. A corner that repeats makes a triangle without
  /// sides, whose half-edges match each other: it is left out.
  void add_facet(std::uint32_t v, std::uint32_t first) {
    std::vector<std::uint32_t> corners;
    std::uint32_t f = first;
    do {
      const std::uint32_t n = number_[f];
      if (corners.empty() || corners.back() != n) corners.push_back(n);
      const IndexedTriangle& t = facets_[f];
      f = around_.at({v, t[0] == v ? t[2] : t[1] == v ? t[0] : t[1]});
    } while (f != first);
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    for (std::size_t k = 2; k < corners.size(); ++k) {
      if (corners[0] == corners[k - 1] || corners[0] == corners[k]) continue;
      cell_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      cell_.half_spaces.push_back(v);
    }
  }

  Triple<Exact> four_origins_{Exact(0), Exact(0), Exact(0)};
  DualPoints points_;
  std::vector<IndexedTriangle> facets_;
  std::vector<std::uint32_t> number_;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> around_;
  HalfSpaceCell cell_;
};

}  // namespace

std::array<HalfSpace, 6> half_spaces_of(const Bounds& box) {
  std::array<HalfSpace, 6> out;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      HalfSpace h{box.low, box.low, box.low};
      for (Vec3& p : h) p[axis] = high ? box.high[axis] : box.low[axis];
      h[high ? 1 : 2][u] = box.high[u];
      h[high ? 2 : 1][v] = box.high[v];
      out[static_cast<std::size_t>(2 * axis + (high ? 1 : 0))] = h;
    }
  }
  return out;
}

HalfSpaceCell intersect_half_spaces(std::span<const HalfSpace> half_spaces,
                                    const std::array<Vec3, 4>& inside) {
  return DualHull().run(half_spaces, inside);
}

}  // namespace penumbra::detail
