#include "volumes/cells/solid_shape.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "penumbra/volumes/predicates/predicates.h"

namespace penumbra::detail {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;

Point exact(const Vec3& p) {
  return {p.x, p.y, p.z};
}

class SolidExaminer {
 public:
  SolidExaminer(const TriangleMesh& mesh, const Component& component) : mesh_(mesh), component_(component) {}

  SolidShape run() const {
    if (!component_.closed || !(component_.signed_volume > 0.0)) return {};
    const bool convex_edges = bends_outward_everywhere();
    const auto inside = convex_edges ? tetrahedron() : mean();
    if (!inside || !is_star_shaped_about(*inside)) return {};
    return {convex_edges ? SolidKind::kConvex : SolidKind::kStarShaped, *inside};
  }

 private:
  const Vec3& corner(FaceId f, int k) const { return mesh_.positions()[mesh_.triangles()[index(f)][k]]; }
  Vec3 rounded_normal(FaceId f) const {
    return glm::cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0));
  }
  std::array<Point, 3> exact_corners(FaceId f) const {
    return {exact(corner(f, 0)), exact(corner(f, 1)), exact(corner(f, 2))};
  }

  bool bends_outward_everywhere() const {
    for (const FaceId f : component_.faces) {
      for (const EdgeId e : mesh_.face_edges()[index(f)]) {
        const Edge& edge = mesh_.edges()[index(e)];
        if (edge.left != f) continue;
        if (orient3d(mesh_.position(edge.from), mesh_.position(edge.to), mesh_.position(edge.left_apex),
                     mesh_.position(edge.right_apex)) == Sign::kPositive)
          return false;
      }
    }
    return true;
  }

  /// Of the largest face and the vertex farthest below it, by rounded arithmetic: if the component is convex,
  /// the average is strictly inside, and otherwise it will be found not to be. Of a sliver the normal would
  /// be rounded to anything.
  std::optional<std::array<Vec3, 4>> tetrahedron() const {
    const auto area2 = [&](FaceId f) { return glm::dot(rounded_normal(f), rounded_normal(f)); };
    const FaceId largest = *std::max_element(component_.faces.begin(), component_.faces.end(),
                                             [&](FaceId f, FaceId g) { return area2(f) < area2(g); });
    const Vec3 &a = corner(largest, 0), &b = corner(largest, 1), &c = corner(largest, 2);
    const Vec3 normal = rounded_normal(largest);
    const Vec3* lowest = nullptr;
    double least = 0.0;
    for (const FaceId f : component_.faces) {
      for (int k = 0; k < 3; ++k) {
        const double height = glm::dot(normal, corner(f, k) - a);
        if (height < least) least = height, lowest = &corner(f, k);
      }
    }
    if (!lowest) return std::nullopt;
    return std::array{a, b, c, *lowest};
  }

  std::optional<std::array<Vec3, 4>> mean() const {
    Vec3 sum(0.0);
    for (const FaceId f : component_.faces) {
      for (int k = 0; k < 3; ++k) sum += corner(f, k) / (3.0 * static_cast<double>(component_.faces.size()));
    }
    return std::array{sum, sum, sum, sum};
  }

  bool is_star_shaped_about(const std::array<Vec3, 4>& inside) const {
    const Point o = CGAL::centroid(exact(inside[0]), exact(inside[1]), exact(inside[2]), exact(inside[3]));
    for (const FaceId f : component_.faces) {
      const auto [a, b, c] = exact_corners(f);
      if (CGAL::orientation(a, b, c, o) != CGAL::NEGATIVE) return false;
    }
    const auto [a, b, c] = exact_corners(component_.faces.front());
    const Point target = CGAL::centroid(a, b, c);
    return std::none_of(component_.faces.begin() + 1, component_.faces.end(),
                        [&](FaceId f) { return cone_holds(o, exact_corners(f), target); });
  }

  /// Whether the closed cone from o over a face, o below it, holds the point.
  static bool cone_holds(const Point& o, const std::array<Point, 3>& t, const Point& p) {
    return CGAL::orientation(o, t[0], t[1], p) != CGAL::NEGATIVE &&
           CGAL::orientation(o, t[1], t[2], p) != CGAL::NEGATIVE &&
           CGAL::orientation(o, t[2], t[0], p) != CGAL::NEGATIVE;
  }

  const TriangleMesh& mesh_;
  const Component& component_;
};

}  // namespace

SolidShape shape_of_solid(const TriangleMesh& mesh, const Component& component) {
  return SolidExaminer(mesh, component).run();
}

}  // namespace penumbra::detail
