#include "render/bake/charts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

#include "mesh/vectors.h"
#include "penumbra/render/bake/bake_receivers.h"
#include "render/bake/clip.h"
#include "render/bake/uv_overlaps.h"

namespace penumbra::detail {
namespace {

/// Overlaps of less than this share of a chart's area are rounding.
constexpr double kOverlap = 1e-9;
/// Of a chart's longer side.
constexpr double kLeastHeight = 1e-16;

/// Counter-clockwise, by monotone chains (Andrew, 1979).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points, [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  const auto add = [&hull](const glm::dvec2& p, std::size_t keep) {
    while (hull.size() >= keep + 2 &&
           !(cross(hull.back() - hull[hull.size() - 2], p - hull[hull.size() - 2]) > 0.0))
      hull.pop_back();
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec2& p) {
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  glm::dvec2 size() const { return high - low; }
};

glm::dvec2 turned(const glm::dvec2& p, const glm::dvec2& axis) {
  return {p.x * axis.x + p.y * axis.y, p.y * axis.x - p.x * axis.y};
}

/// The direction of the side of the hull along which the bounding box is smallest; the longer side of the box
/// runs along it.
glm::dvec2 best_axis(const std::vector<glm::dvec2>& hull) {
  glm::dvec2 best(1.0, 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::dvec2 side = hull[(i + 1) % hull.size()] - hull[i];
    const double length = std::hypot(side.x, side.y);
    if (!(length > 0.0)) continue;
    Extent box;
    for (const glm::dvec2& p : hull) box.add(turned(p, side / length));
    const double area = box.size().x * box.size().y;
    if (!(area < least)) continue;
    least = area;
    best = box.size().x >= box.size().y ? side / length : glm::dvec2(-side.y, side.x) / length;
  }
  return best;
}

class ChartMaker {
 public:
  ChartMaker(const TriangleMesh& mesh, std::uint32_t object, double degrees)
      : mesh_(mesh), object_(object), least_cosine_(std::cos(degrees * std::numbers::pi / 180.0)) {
    for (std::uint32_t f = 0; f < mesh.triangles().size(); ++f) {
      normals_.push_back(face_normal(mesh, f));
      done_.push_back(normals_.back() == Vec3(0.0));
    }
  }

  std::vector<Chart> make() {
    std::vector<Chart> charts;
    for (std::uint32_t f = 0; f < done_.size(); ++f)
      while (!done_[f]) charts.push_back(flatten(grow(f)));
    return charts;
  }

 private:
  std::vector<std::uint32_t> grow(std::uint32_t seed) {
    std::vector<std::uint32_t> faces{seed};
    done_[seed] = true;
    for (std::size_t next = 0; next < faces.size(); ++next)
      for (const EdgeId e : mesh_.face_edges()[faces[next]]) {
        const Edge& edge = mesh_.edges()[index(e)];
        if (edge.is_boundary()) continue;
        const std::size_t other = index(index(edge.left) == faces[next] ? edge.right : edge.left);
        if (done_[other] || glm::dot(normals_[other], normals_[seed]) < least_cosine_) continue;
        done_[other] = true;
        faces.push_back(static_cast<std::uint32_t>(other));
      }
    return faces;
  }

  /// Gives back the faces that overlap earlier ones: they are not done.
  Chart flatten(std::vector<std::uint32_t> faces) {
    Chart chart{.object = object_, .faces = std::move(faces), .uv = {}};
    project(chart);
    double area = 0.0;
    for (const FaceUv& t : chart.uv) area += 0.5 * std::abs(doubled_area(t));
    std::vector<bool> kept(chart.faces.size(), true);
    for (const auto& [i, j] :
         find_overlaps(chart.uv, kOverlap * area, std::numeric_limits<std::size_t>::max()))
      if (kept[i]) kept[j] = false;
    Chart rest{.object = object_, .faces = {}, .uv = {}};
    for (std::size_t i = 0; i < chart.faces.size(); ++i) {
      if (!kept[i]) {
        done_[chart.faces[i]] = false;
        continue;
      }
      rest.faces.push_back(chart.faces[i]);
      rest.uv.push_back(chart.uv[i]);
    }
    fit_box(rest);
    return rest;
  }

  void project(Chart& chart) const {
    Vec3 sum(0.0);
    const auto p = mesh_.positions();
    for (const std::uint32_t f : chart.faces) {
      const auto& [a, b, c] = mesh_.triangles()[f];
      sum += glm::cross(p[b] - p[a], p[c] - p[a]);
    }
    const Vec3 normal = unit(sum);
    // From outside x runs to the right and y down.
    const Vec3 x = unit_perpendicular(normal), y = glm::cross(x, normal);
    const Vec3 origin = p[mesh_.triangles()[chart.faces[0]][0]];
    for (const std::uint32_t f : chart.faces) {
      FaceUv& uv = chart.uv.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 d = p[mesh_.triangles()[f][k]] - origin;
        uv[k] = {glm::dot(d, x), glm::dot(d, y)};
      }
    }
  }

  static void fit_box(Chart& chart) {
    std::vector<glm::dvec2> points;
    for (const FaceUv& t : chart.uv) points.insert(points.end(), t.begin(), t.end());
    const glm::dvec2 axis = best_axis(convex_hull(std::move(points)));
    Extent box;
    for (FaceUv& t : chart.uv)
      for (glm::dvec2& p : t) box.add(p = turned(p, axis));
    for (FaceUv& t : chart.uv)
      for (glm::dvec2& p : t) p -= box.low;
    // Rounding may leave a sliver no height.
    const glm::dvec2 size = box.size();
    chart.extent = glm::max(size, glm::dvec2(kLeastHeight * std::max(size.x, size.y)));
  }

  const TriangleMesh& mesh_;
  std::uint32_t object_;
  double least_cosine_;
  std::vector<Vec3> normals_;
  std::vector<bool> done_;
};

}  // namespace

std::vector<Chart> make_charts(const TriangleMesh& mesh, std::uint32_t object, double degrees) {
  return ChartMaker(mesh, object, degrees).make();
}

}  // namespace penumbra::detail
