#include "volumes/solids/carve.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

/// The first pull, of an edge, and how many times as far each next one is.
constexpr double kFirstPull = 1.0 / 200, kPullGrowth = 1.6;
/// Where an edge begins that is crossed since a grid point changed sides: so far from that point.
constexpr double kStart = 1.0 / 16;
/// Of the grid's spacing: so far outside of triangles that cannot be proved points are tried, so that what they bulge between the
/// points is in umbra as well.
constexpr double kMargin = 0.05;
/// Of a tolerance, along the grid's axes: these points are at most so far apart. Their lattice divides sides into at least so many.
constexpr double kApart = 0.18;
constexpr int kFewestParts = 5;

/// Moves what bad triangles touch.
class Carver {
 public:
  Carver(SolidGrid& grid, CrossedEdges& edges, bool inward) : grid_(grid), edges_(edges), inward_(inward) {}

  void pull(std::uint32_t number) {
    CrossedEdge& e = edges_.all()[number];
    if (e.moved || e.in_wall) return;  // pulled already, or fixed
    e.moved = true;
    e.pull = e.pull > 0.0 ? kPullGrowth * e.pull : kFirstPull;
    e.at += inward_ ? -e.pull : e.pull;
    if (e.at <= 0.0) flip(edges_.inner_end(e));
    if (e.at >= 1.0) flip(edges_.outer_end(e));
  }
  void flip(std::uint32_t vertex) { flipped_.push_back(vertex); }
  /// The corners that are set in `which`. Where they are grid points of a cap, those change sides.
  void move(const GridSurface& surface, const IndexedTriangle& t, unsigned which) {
    const std::size_t edge_count = edges_.all().size();
    for (int k = 0; k < 3; ++k) {
      if (!(which >> k & 1)) continue;
      if (t[k] < edge_count)
        pull(t[k]);
      else
        flip(surface.cap_points[t[k] - edge_count]);
    }
  }

  void finish() {
    for (const std::uint32_t v : flipped_) grid_.set_inside(v, !inward_);
    if (!flipped_.empty()) edges_.update(inward_ ? 1.0 - kStart : kStart, kStart / 2.0);
    flipped_.clear();
  }

 private:
  SolidGrid& grid_;
  CrossedEdges& edges_;
  bool inward_;
  std::vector<std::uint32_t> flipped_;
};

/// Of a surface, the triangles that have a corner which has moved. Of a penumbra those of caps and those in the light's plane need no
/// judgment.
std::vector<std::size_t> changed(const GridSurface& surface, const CrossedEdges& edges, bool with_caps) {
  std::vector<std::size_t> out;
  const std::size_t count = with_caps ? surface.triangles.size() : surface.inner_triangles;
  const auto has_moved = [&](std::uint32_t v) { return v >= edges.all().size() || edges.all()[v].moved; };
  const auto in_wall = [&](std::uint32_t v) { return v < edges.all().size() && edges.all()[v].in_wall; };
  for (std::size_t i = 0; i < count; ++i)
    if (std::ranges::all_of(surface.triangles[i], in_wall))
      continue;
    else if (std::ranges::any_of(surface.triangles[i], has_moved) ||
             (i < surface.inner_triangles && has_moved(surface.fourth[i])))
      out.push_back(i);
  return out;
}

/// What was found of the points of a surface's triangles, for the next surface on the same grid.
class KnownPoints {
 public:
  /// Of triangles of a surface that follows. A point that had no fault hardly ever has one after it has moved to the safe side, so
  /// it is tried again only with the proofs.
  TrianglePoints::Known of(const GridSurface& surface, std::span<const std::size_t> which) const {
    TrianglePoints::Known out(which.size(), 0);
    for (std::size_t i = 0; i < which.size(); ++i) {
      if (which[i] >= surface.inner_triangles) continue;
      const auto at = std::ranges::lower_bound(names_, surface.names[which[i]]);
      if (at != names_.end() && *at == surface.names[which[i]])
        out[i] = known_[static_cast<std::size_t>(at - names_.begin())];
    }
    return out;
  }
  /// Triangles that were not looked at have no fault.
  void remember(const GridSurface& surface, std::span<const std::size_t> which,
                const TrianglePoints::Known& found) {
    names_ = surface.names;
    known_.assign(names_.size(), TrianglePoints::kWhole);
    for (std::size_t i = 0; i < which.size(); ++i)
      if (which[i] < names_.size()) known_[which[i]] = found[i];
  }

 private:
  std::vector<std::uint64_t> names_;
  TrianglePoints::Known known_;
};

/// Positions moved outward along the mean normals of the triangles that meet there, but not out of the grid's box.
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

}  // namespace

GridSurface carve(SolidGrid& grid, CrossedEdges& edges, const SolidMeshRequest& request,
                  const TriangleJudge& judge, std::size_t& evaluations, const Progress& progress) {
  const bool umbra = request.region == ShadowRegion::kUmbra;
  const double spacing = std::max({grid.step().x, grid.step().y, grid.step().z});
  const int parts =
      std::max(kFewestParts, static_cast<int>(std::ceil(spacing / (kApart * request.tolerance))));
  Carver carver(grid, edges, umbra);
  KnownPoints points;
  for (bool proofs = !umbra;;) {
    GridSurface surface = grid_surface(edges, umbra ? Diagonals::kSmaller : Diagonals::kLarger);
    const std::vector<std::size_t> which = changed(surface, edges, umbra);
    std::vector<IndexedTriangle> triangles;
    for (const std::size_t i : which) triangles.push_back(surface.triangles[i]);
    const TriangleJudge::Surface part{surface.positions, triangles};
    TriangleJudge::Faults faults;
    if (proofs) {
      faults =
          judge.try_proofs(part, umbra ? grown(surface, kMargin * spacing, grid.box()) : surface.positions,
                           parts, evaluations);
    } else {
      TrianglePoints::Known known = points.of(surface, which);
      faults = judge.try_middles(part, known, evaluations);
      points.remember(surface, which, known);
    }
    report(progress,
           (proofs ? 0.5 : 0.0) + 0.5 * (1.0 - static_cast<double>(which.size()) /
                                                   static_cast<double>(surface.triangles.size() + 1)));
    for (CrossedEdge& e : edges.all()) e.moved = false;
    const bool any = std::ranges::any_of(faults, [](std::uint8_t f) { return f != 0; });
    if (!any && proofs) return surface;
    for (std::size_t k = 0; k < triangles.size(); ++k)
      if (faults[k] != 0) carver.move(surface, triangles[k], faults[k]);
    carver.finish();
    if (!any) {
      proofs = true;
      for (CrossedEdge& e : edges.all()) e.moved = true;
    }
  }
}

}  // namespace penumbra::detail
