#include "volumes/solids/carve.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "volumes/solids/carver.h"
#include "volumes/solids/triangle_states.h"

namespace penumbra::detail {
namespace {

/// Of the grid's spacing: so far outside of triangles that cannot be proved points are tried, so that what
/// they bulge between the points is in umbra as well.
constexpr double kMargin = 0.05;
/// Of a tolerance, along the grid's axes: these points are at most so far apart. Their lattice divides sides
/// into at least so many.
constexpr double kApart = 0.18;
constexpr int kFewestParts = 5;

constexpr std::uint8_t kAllCorners = 7;
/// Of proofs, which are tried again and again.
constexpr HiddenProof::Effort kQuick{.depth = 0, .thorough = false};

/// Positions moved outward along the mean normals of the triangles that meet there, but not out of the grid's
/// box.
std::vector<Vec3> grown(const GridSurface& surface, double by, const Bounds& box) {
  std::vector<Vec3> normals(surface.positions.size(), Vec3(0.0));
  for (std::size_t i = 0; i < surface.inner_triangles; ++i) {
    const IndexedTriangle& t = surface.triangles[i];
    const auto& p = surface.positions;
    const Vec3 normal = glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
    for (const std::uint32_t v : t) normals[v] += normal;
  }
  std::vector<Vec3> out = surface.positions;
  for (std::size_t v = 0; v < out.size(); ++v) {
    const double length = glm::length(normals[v]);
    if (length > 0.0) out[v] = glm::clamp(out[v] + by / length * normals[v], box.low, box.high);
  }
  return out;
}

class UmbraCarving {
 public:
  UmbraCarving(SolidGrid& grid, CrossedEdges& edges, const TriangleJudge& judge, std::size_t& evaluations,
               const Progress& progress)
      : grid_(grid),
        edges_(edges),
        judge_(judge),
        evaluations_(evaluations),
        progress_(progress),
        margin_(kMargin * std::max({grid.step().x, grid.step().y, grid.step().z})),
        carver_(grid, edges, true) {}

  /// Most faults show at few points, most of these on the surface. So triangles are pulled to where these
  /// have none before more points, outside of the surface, are tried.
  GridSurface run(const PointPattern& lattice) {
    const PointPattern middles = middle_points();
    carve_by({middles, false, 0.0});
    states_.forget_points();
    carve_by({middles, true, 1.0 / 3.0});
    states_.forget_points();
    while (carve_by({lattice, true, 2.0 / 3.0})) {
    }
    return std::move(surface_);
  }

 private:
  struct Pass {
    const PointPattern& points;
    bool outside;  ///< of the surface they are tried
    double done;   ///< progress
  };

  /// False where no triangle has a fault.
  bool carve_by(const Pass& pass) {
    if (!look_at_all(pass)) return false;
    while (look_again(pass)) {
    }
    return true;
  }

  /// All triangles that have moved since this was done, or of whose points nothing is known: they are proved,
  /// or tried. Those that have a fault are moved. False where none has.
  bool look_at_all(const Pass& pass) {
    begin();
    const std::vector<std::size_t> which =
        those([&](std::size_t i) { return has_moved(i, &CrossedEdge::doubtful) || states_.is_open(i); });
    for (CrossedEdge& e : edges_.all()) e.moved = e.doubtful = false;
    report_what_is_left(pass, which.size());
    const std::vector<char> proved = judge_.prove({surface_.positions, triangles(which)}, kQuick);
    // Bisection saw nothing at corners on the surface.
    const std::uint8_t known = pass.outside ? 0 : kAllCorners;
    for (std::size_t k = 0; k < which.size(); ++k) states_.set(which[k], proved[k] != 0, known);
    return try_points(unproved(which, proved), pass);
  }

  /// Those that had a fault and have moved since: they are proved, or those of their points are tried that
  /// had one.
  bool look_again(const Pass& pass) {
    begin();
    std::vector<std::size_t> which = those([&](std::size_t i) {
      return has_moved(i, &CrossedEdge::moved) && states_.is_unproved(i) && states_.is_open(i);
    });
    for (CrossedEdge& e : edges_.all()) e.moved = false;
    report_what_is_left(pass, which.size());
    if (pass.outside) {  // else nearly all of them see light
      const std::vector<char> proved = judge_.prove({surface_.positions, triangles(which)}, kQuick);
      for (std::size_t k = 0; k < which.size(); ++k)
        if (proved[k]) states_.set(which[k], true, 0);
      which = unproved(which, proved);
    }
    return try_points(which, pass);
  }

  void begin() {
    surface_ = grid_surface(edges_, Diagonals::kSmaller);
    states_.carry_to(surface_);
  }

  bool has_moved(std::size_t i, bool CrossedEdge::*mark) const {
    const std::vector<CrossedEdge>& all = edges_.all();
    const auto is_marked = [&](std::uint32_t v) { return v < all.size() && all[v].*mark; };
    return std::ranges::any_of(surface_.triangles[i], is_marked) ||
           (i < surface_.inner_triangles && is_marked(surface_.fourth[i]));
  }
  template <class Is>
  std::vector<std::size_t> those(const Is& is) const {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < surface_.triangles.size(); ++i)
      if (is(i)) out.push_back(i);
    return out;
  }
  static std::vector<std::size_t> unproved(const std::vector<std::size_t>& which,
                                           const std::vector<char>& proved) {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < which.size(); ++k)
      if (!proved[k]) out.push_back(which[k]);
    return out;
  }
  std::vector<IndexedTriangle> triangles(const std::vector<std::size_t>& which) const {
    std::vector<IndexedTriangle> out;
    for (const std::size_t i : which) out.push_back(surface_.triangles[i]);
    return out;
  }
  void report_what_is_left(const Pass& pass, std::size_t count) const {
    const double left = static_cast<double>(count) / static_cast<double>(surface_.triangles.size() + 1);
    report(progress_, pass.done + (1.0 - left) / 3.0);
  }

  bool try_points(const std::vector<std::size_t>& asked, const Pass& pass) {
    TrianglePoints::Known known;
    for (const std::size_t i : asked) known.push_back(states_.of(i));
    const std::vector<IndexedTriangle> some = triangles(asked);
    const std::vector<Vec3> outside =
        pass.outside && !asked.empty() ? grown(surface_, margin_, grid_.box()) : std::vector<Vec3>{};
    const TriangleJudge::Faults faults = judge_.try_points(
        {pass.outside ? outside : surface_.positions, some}, pass.points, known, evaluations_);
    bool any = false;
    for (std::size_t k = 0; k < asked.size(); ++k) {
      states_.set_parts(asked[k], known[k]);
      if (faults[k] == 0) continue;
      any = true;
      carver_.move(surface_, some[k], faults[k]);
    }
    carver_.finish();
    return any;
  }

  SolidGrid& grid_;
  CrossedEdges& edges_;
  const TriangleJudge& judge_;
  std::size_t& evaluations_;
  const Progress& progress_;
  double margin_;
  Carver carver_;
  GridSurface surface_;
  TriangleStates states_;
};

/// Of a penumbra, the triangles that have a corner which has moved. Those of caps and those in the light's
/// plane need no judgment.
std::vector<std::size_t> moved(const GridSurface& surface, const CrossedEdges& edges) {
  std::vector<std::size_t> out;
  const auto has_moved = [&](std::uint32_t v) { return edges.all()[v].moved; };
  const auto in_wall = [&](std::uint32_t v) { return edges.all()[v].in_wall; };
  for (std::size_t i = 0; i < surface.inner_triangles; ++i)
    if (!std::ranges::all_of(surface.triangles[i], in_wall) &&
        (std::ranges::any_of(surface.triangles[i], has_moved) || has_moved(surface.fourth[i])))
      out.push_back(i);
  return out;
}

GridSurface carve_penumbra(SolidGrid& grid, CrossedEdges& edges, const TriangleJudge& judge,
                           const Progress& progress) {
  Carver carver(grid, edges, false);
  for (;;) {
    GridSurface surface = grid_surface(edges, Diagonals::kLarger);
    const std::vector<std::size_t> which = moved(surface, edges);
    std::vector<IndexedTriangle> triangles;
    for (const std::size_t i : which) triangles.push_back(surface.triangles[i]);
    const std::vector<char> proved = judge.prove({surface.positions, triangles}, kQuick);
    report(progress,
           1.0 - static_cast<double>(which.size()) / static_cast<double>(surface.triangles.size() + 1));
    for (CrossedEdge& e : edges.all()) e.moved = false;
    if (std::ranges::all_of(proved, [](char p) { return p != 0; })) return surface;
    for (std::size_t k = 0; k < triangles.size(); ++k)
      if (!proved[k]) carver.move(surface, triangles[k], kAllCorners);
    carver.finish();
  }
}

}  // namespace

GridSurface carve(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request,
                  const TriangleJudge& judge, std::size_t& evaluations, const Progress& progress) {
  if (request.region == ShadowRegion::kPenumbra) return carve_penumbra(grid, edges, judge, progress);
  const double spacing = std::max({grid.step().x, grid.step().y, grid.step().z});
  const int parts =
      std::max(kFewestParts, static_cast<int>(std::ceil(spacing / (kApart * request.tolerance))));
  return UmbraCarving(grid, edges, judge, evaluations, progress).run(lattice_points(parts));
}

}  // namespace penumbra::detail
