#include "volumes/checks/surface_queries.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace penumbra::detail {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
using Polygons = std::vector<std::vector<std::size_t>>;

std::vector<Point> points_of(std::span<const Vec3> positions) {
  std::vector<Point> points;
  points.reserve(positions.size());
  for (const Vec3& p : positions) points.emplace_back(p.x, p.y, p.z);
  return points;
}

Polygons polygons_of(std::span<const IndexedTriangle> triangles) {
  Polygons polygons;
  polygons.reserve(triangles.size());
  for (const IndexedTriangle& t : triangles) polygons.push_back({t[0], t[1], t[2]});
  return polygons;
}

/// Two triangles, those corners first that they share.
class TrianglePair {
 public:
  TrianglePair(const std::vector<Point>& points, IndexedTriangle s, IndexedTriangle t)
      : points_(points), s_(s), t_(t) {
    for (int i = 0; i < 3; ++i) {
      const auto at = std::find(t_.begin() + shared_, t_.end(), s_[i]);
      if (at == t_.end()) continue;
      std::iter_swap(t_.begin() + shared_, at);
      std::swap(s_[shared_], s_[i]);
      ++shared_;
    }
  }

  bool intersect() const {
    switch (shared_) {
      case 0:
        return CGAL::do_intersect(triangle(s_), triangle(t_));
      case 1:
        return CGAL::do_intersect(Kernel::Segment_3(point(s_[1]), point(s_[2])), triangle(t_)) ||
               CGAL::do_intersect(Kernel::Segment_3(point(t_[1]), point(t_[2])), triangle(s_));
      case 2:
        return CGAL::coplanar(point(s_[0]), point(s_[1]), point(s_[2]), point(t_[2])) &&
               CGAL::coplanar_orientation(point(s_[0]), point(s_[1]), point(s_[2]), point(t_[2])) ==
                   CGAL::POSITIVE;
      default:
        return true;
    }
  }

 private:
  const Point& point(std::uint32_t v) const { return points_[v]; }
  Kernel::Triangle_3 triangle(const IndexedTriangle& t) const {
    return {point(t[0]), point(t[1]), point(t[2])};
  }

  const std::vector<Point>& points_;
  IndexedTriangle s_, t_;
  int shared_ = 0;
};

struct Enough {};

}  // namespace

std::vector<FacePair> self_intersections(std::span<const Vec3> positions,
                                         std::span<const IndexedTriangle> triangles, std::size_t limit) {
  const std::vector<Point> points = points_of(positions);
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const IndexedTriangle& t = triangles[i];
    boxes.emplace_back(points[t[0]].bbox() + points[t[1]].bbox() + points[t[2]].bbox(), i);
  }
  std::vector<FacePair> pairs;
  const auto visit = [&](const Box& a, const Box& b) {
    if (!TrianglePair(points, triangles[a.info()], triangles[b.info()]).intersect()) return;
    if (pairs.size() == limit) throw Enough();
    pairs.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
  };
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), visit);
  } catch (const Enough&) {
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool does_bound_a_volume(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles) {
  const std::vector<Point> points = points_of(positions);
  const Polygons polygons = polygons_of(triangles);
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) return false;
  CGAL::Surface_mesh<Point> mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  return CGAL::is_closed(mesh) && pmp::does_bound_a_volume(mesh) && pmp::volume(mesh) > 0.0;
}

std::optional<std::vector<IndexedTriangle>> oriented_alike(std::span<const Vec3> positions,
                                                           std::span<const IndexedTriangle> triangles) {
  std::vector<Point> points = points_of(positions);
  Polygons polygons = polygons_of(triangles);
  if (!pmp::orient_polygon_soup(points, polygons)) return std::nullopt;
  std::vector<IndexedTriangle> result;
  for (const auto& p : polygons) {
    result.push_back({static_cast<std::uint32_t>(p[0]), static_cast<std::uint32_t>(p[1]),
                      static_cast<std::uint32_t>(p[2])});
  }
  return result;
}

}  // namespace penumbra::detail
