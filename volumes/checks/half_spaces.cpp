#include "volumes/checks/half_spaces.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <map>
#include <tuple>

namespace penumbra::detail {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Hull = CGAL::Surface_mesh<Point>;

/// normal · x ≤ offset, x counted from the inside point.
struct Plane {
  Vector normal;
  Number offset;
};

Point exact(const Vec3& p) {
  return {p.x, p.y, p.z};
}

/// By the exact value: rounding a lazy number is good to 1e-5 only.
double rounded(const Number& x) {
  return CGAL::to_double(CGAL::exact(x));
}

/// About the inside point a plane n·x = d is dual to the point n/d: the convex hull of the dual points has a
/// vertex for each plane that bounds the intersection, and a facet for each corner of it.
class DualHull {
 public:
  DualHull(std::span<const HalfSpace> half_spaces, const std::array<Vec3, 4>& inside)
      : origin_(CGAL::centroid(exact(inside[0]), exact(inside[1]), exact(inside[2]), exact(inside[3]))) {
    for (const HalfSpace& h : half_spaces) {
      const Point a = exact(h[0]);
      const Vector normal = CGAL::cross_product(exact(h[1]) - a, exact(h[2]) - a);
      planes_.push_back({normal, normal * (a - origin_)});
    }
  }

  HalfSpaceCell run() {
    std::vector<Point> duals;
    for (std::uint32_t i = 0; i < planes_.size(); ++i) {
      const Plane& plane = planes_[i];
      if (!(plane.offset > 0)) return {};
      const Vector dual = plane.normal / plane.offset;
      duals.push_back(CGAL::ORIGIN + dual);
      plane_of_.try_emplace(duals.back(), i);
    }
    CGAL::convex_hull_3(duals.begin(), duals.end(), hull_);
    number_corners();
    for (const Hull::Vertex_index v : hull_.vertices()) add_facet(v);
    return std::move(cell_);
  }

 private:
  std::uint32_t plane_at(Hull::Vertex_index v) const { return plane_of_.at(hull_.point(v)); }

  /// Where three planes meet, by Cramer's rule.
  Vec3 corner(Hull::Face_index f) const {
    const Hull::Halfedge_index h = hull_.halfedge(f);
    const Plane &p = planes_[plane_at(hull_.target(h))], &q = planes_[plane_at(hull_.target(hull_.next(h)))],
                &r = planes_[plane_at(hull_.source(h))];
    const Vector qr = CGAL::cross_product(q.normal, r.normal), rp = CGAL::cross_product(r.normal, p.normal),
                 pq = CGAL::cross_product(p.normal, q.normal);
    const Vector sum = p.offset * qr + q.offset * rp + r.offset * pq;
    const Point x = origin_ + sum / (p.normal * qr);
    return {rounded(x.x()), rounded(x.y()), rounded(x.z())};
  }

  /// Facets of one corner's plane, and corners that round to the same doubles, are one corner.
  void number_corners() {
    const auto less = [](const Vec3& a, const Vec3& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<Vec3, std::uint32_t, decltype(less)> numbers(less);
    number_.resize(hull_.number_of_faces());
    for (const Hull::Face_index f : hull_.faces()) {
      const Vec3 x = corner(f);
      const auto [at, is_new] = numbers.try_emplace(x, static_cast<std::uint32_t>(cell_.positions.size()));
      if (is_new) cell_.positions.push_back(x);
      number_[f] = at->second;
    }
  }

  /// The corners around a plane, counter-clockwise, as a fan. A corner that repeats makes a triangle without
  /// sides, whose half-edges match each other: it is left out.
  void add_facet(Hull::Vertex_index v) {
    std::vector<std::uint32_t> corners;
    const Hull::Halfedge_index first = hull_.halfedge(v);
    Hull::Halfedge_index h = first;
    do {
      const std::uint32_t n = number_[hull_.face(h)];
      if (corners.empty() || corners.back() != n) corners.push_back(n);
      h = hull_.prev(hull_.opposite(h));
    } while (h != first);
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    for (std::size_t k = 2; k < corners.size(); ++k) {
      if (corners[0] == corners[k - 1] || corners[0] == corners[k]) continue;
      cell_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      cell_.half_spaces.push_back(plane_at(v));
    }
  }

  Point origin_;
  std::vector<Plane> planes_;
  std::map<Point, std::uint32_t> plane_of_;
  Hull hull_;
  std::vector<std::uint32_t> number_;
  HalfSpaceCell cell_;
};

}  // namespace

HalfSpaceCell intersect_half_spaces(std::span<const HalfSpace> half_spaces,
                                    const std::array<Vec3, 4>& inside) {
  return DualHull(half_spaces, inside).run();
}

}  // namespace penumbra::detail
