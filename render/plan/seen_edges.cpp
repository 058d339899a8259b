#include "render/plan/seen_edges.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace penumbra::detail {
namespace {

// As the silhouette method merges: faces of casters that have so many; and the length of what is left, light radii, about.
constexpr std::size_t kFine = 1024;
constexpr double kLong = 0.1;

/// Calls visit(mesh, i) for `count` of the items of all casters that may reach, of which each has `items(mesh)`, or for all where
/// there are no more. Returns how many items one of these stands for.
template <class Items, class Visit>
double visit_some(const Scene& objects, std::span<const CasterFacts> casters, std::size_t count,
                  const Items& items, const Visit& visit) {
  std::size_t all = 0;
  for (const CasterFacts& caster : casters)
    if (caster.reach == CasterReach::kMayReach) all += items(objects.objects[caster.object].mesh);
  const std::size_t some = std::min(all, count);
  std::size_t before = 0, k = 0;
  for (const CasterFacts& caster : casters) {
    if (caster.reach != CasterReach::kMayReach) continue;
    const TriangleMesh& mesh = objects.objects[caster.object].mesh;
    const std::size_t here = items(mesh);
    for (; k < some; ++k) {
      const std::size_t at = (2 * k + 1) * all / (2 * some);
      if (at >= before + here) break;
      visit(mesh, at - before);
    }
    before += here;
  }
  return some > 0 ? static_cast<double>(all) / static_cast<double>(some) : 1.0;
}

}  // namespace

EdgeSample::EdgeSample(const Scene& objects, const CircularLight& light, std::span<const CasterFacts> casters,
                       std::size_t count)
    : light_(light), axes_(light_frame(light)) {
  each_stands_for_ = visit_some(
      objects, casters, count, [](const TriangleMesh& mesh) { return mesh.edges().size(); },
      [&](const TriangleMesh& mesh, std::size_t i) {
        const Edge& edge = mesh.edges()[i];
        const Vec3 from = in_frame(mesh.position(edge.from)), to = in_frame(mesh.position(edge.to));
        Seen seen{from,
                  to,
                  {Vec3(0.0), Vec3(0.0)},
                  {0.0, 0.0},
                  edge.is_boundary(),
                  !edge.is_boundary() && mesh.triangles().size() >= kFine};
        const auto set_plane = [&](std::size_t k, VertexId apex, const Vec3& along) {
          seen.normals[k] = glm::cross(along, in_frame(mesh.position(apex)) - from);
          seen.offsets[k] = -glm::dot(seen.normals[k], from);
        };
        set_plane(0, edge.left_apex, to - from);
        if (!edge.is_boundary()) set_plane(1, edge.right_apex, from - to);
        band_ += is_in_band(seen) ? 1 : 0;
        edges_.push_back(seen);
      });
}

Vec3 EdgeSample::in_frame(const Vec3& world) const {
  const Vec3 p = light_.is_distant() ? world : world - light_.center;
  return {glm::dot(p, axes_.u), glm::dot(p, axes_.v), glm::dot(p, axes_.w)};
}

bool EdgeSample::is_in_band(const Seen& edge) const {
  if (edge.is_boundary) return true;
  // The plane's height over the light's center, and by how much it changes over the light.
  const auto side = [&](std::size_t k) {
    const Vec3& n = edge.normals[k];
    const double over = light_.is_distant() ? n.z : edge.offsets[k],
                 change = light_.radius * std::hypot(n.x, n.y);
    return over > change ? 1 : over < -change ? -1 : 0;
  };
  return side(0) == 0 || side(0) != side(1);
}

EdgeSample::Crossing EdgeSample::crossing(const Vec3& world) const {
  const Vec3 x = in_frame(world);
  Crossing out;
  for (const Seen& edge : edges_) {
    const bool silhouette = edge.is_boundary || (glm::dot(edge.normals[0], x) + edge.offsets[0] > 0.0) !=
                                                    (glm::dot(edge.normals[1], x) + edge.offsets[1] > 0.0);
    const double length = silhouette ? length_across(edge, x) : 0.0;
    if (!(length > 0.0)) continue;
    out.edges += each_stands_for_;
    out.length += each_stands_for_ * length;
    out.merged += each_stands_for_ * (edge.may_merge ? std::min(1.0, length / kLong) : 1.0);
  }
  return out;
}

/// The part of the edge that lies between x and the light is projected from x onto the disk.
double EdgeSample::length_across(const Seen& edge, const Vec3& x) const {
  const bool distant = light_.is_distant();
  const double low = distant ? -std::numeric_limits<double>::infinity() : 0.0;
  const double high = x.z - 1e-9 * (std::abs(x.z) + glm::length(edge.to - edge.from));
  // Clipped to depths that count.
  double first = 0.0, last = 1.0;
  const double rise = edge.to.z - edge.from.z;
  for (const auto& [limit, sign] : {std::pair{low, -1.0}, std::pair{high, 1.0}}) {
    const double over = sign * (edge.from.z - limit), change = sign * rise;  // over + t change ≤ 0
    if (change > 0.0)
      last = std::min(last, -over / change);
    else if (change < 0.0)
      first = std::max(first, -over / change);
    else if (over > 0.0)
      return 0.0;
  }
  if (!(first < last)) return 0.0;
  const auto project = [&](double t) {
    const Vec3 p = edge.from + t * (edge.to - edge.from);
    const glm::dvec2 way = glm::dvec2(p - x) / (x.z - p.z);
    return (distant ? way : glm::dvec2(x) + way * x.z) / light_.radius;
  };
  const glm::dvec2 a = project(first), d = project(last) - a;
  const double t = std::clamp(-glm::dot(a, d) / std::max(glm::dot(d, d), 1e-300), 0.0, 1.0);
  const glm::dvec2 nearest = a + t * d;
  return glm::dot(nearest, nearest) < 1.0 ? std::min(2.0, glm::length(d)) : 0.0;
}

FaceSample::FaceSample(const Scene& objects, std::span<const CasterFacts> casters, std::size_t count) {
  each_stands_for_ = visit_some(
      objects, casters, count, [](const TriangleMesh& mesh) { return mesh.triangles().size(); },
      [&](const TriangleMesh& mesh, std::size_t i) {
        Bounds& box = boxes_.emplace_back();
        for (const std::uint32_t v : mesh.triangles()[i]) box.add(mesh.positions()[v]);
      });
}

double FaceSample::boxes_on(const Vec3& x, const Vec3& way, bool endless) const {
  std::size_t count = 0;
  const Vec3 inverse = 1.0 / way;
  for (const Bounds& box : boxes_) {
    const Vec3 a = (box.low - x) * inverse, b = (box.high - x) * inverse;
    double first = 0.0, last = endless ? std::numeric_limits<double>::infinity() : 1.0;
    for (int k = 0; k < 3; ++k) {
      first = std::max(first, std::min(a[k], b[k]));
      last = std::min(last, std::max(a[k], b[k]));
    }
    count += first <= last ? 1 : 0;
  }
  return static_cast<double>(count) * each_stands_for_;
}

}  // namespace penumbra::detail
