// Surfaces of random grids, with vertices anywhere on their edges: sound, and still so when they are
// simplified.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "penumbra/volumes/checks/validate.h"
#include "volumes/solids/grid_surface.h"
#include "volumes/solids/simplify/simplify.h"

namespace penumbra::detail {
namespace {

/// Some balls, so that there are smooth parts, thin parts, tunnels and several pieces.
struct RandomGrid {
  explicit RandomGrid(std::uint64_t seed)
      : random(seed), grid({Vec3(0.0), Vec3(1.0, 1.2, 0.9)}, 0.08), edges(grid) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int ball = 0; ball < 5; ++ball) {
      const Vec3 center(unit(random), unit(random), unit(random));
      const double radius = 0.05 + 0.3 * unit(random), hole = unit(random) < 0.4 ? 0.6 * radius : 0.0;
      for (std::uint32_t v = 0; v < grid.size(); ++v) {
        const double d = glm::length(grid.point(v) - center);
        if (d < radius && d >= hole) grid.set_inside(v, true);
      }
    }
    for (std::uint32_t v = 0; v < grid.size(); ++v)
      if (unit(random) < 0.01) grid.set_inside(v, !grid.is_inside(v));
    edges.update(0.5, 0.0);
    for (CrossedEdge& e : edges.all()) e.at = 0.01 + 0.98 * unit(random);
  }

  std::mt19937_64 random;
  SolidGrid grid;
  CrossedEdges edges;
};

double volume_of(std::span<const Vec3> p, std::span<const IndexedTriangle> triangles) {
  double sum = 0.0;
  for (const IndexedTriangle& t : triangles) sum += glm::dot(p[t[0]], glm::cross(p[t[1]], p[t[2]])) / 6.0;
  return sum;
}

void expect_sound(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles) {
  const SurfaceFindings f = check_surface(positions, triangles);
  EXPECT_TRUE(f.closed());
  EXPECT_TRUE(f.degenerate.empty());
  EXPECT_TRUE(f.self_intersections.empty()) << f.self_intersections.size() << " of " << triangles.size();
  EXPECT_TRUE(f.bounds_a_volume);
  EXPECT_TRUE(TriangleMesh::build(positions, triangles).report().non_manifold_edges == 0);
}

TEST(GridSurface, IsSoundForAnyPointsOnItsEdges) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const RandomGrid random(seed);
    const GridSurface larger = grid_surface(random.edges, Diagonals::kLarger),
                      smaller = grid_surface(random.edges, Diagonals::kSmaller);
    expect_sound(larger.positions, larger.triangles);
    expect_sound(smaller.positions, smaller.triangles);
    EXPECT_GE(volume_of(larger.positions, larger.triangles), volume_of(smaller.positions, smaller.triangles));
  }
}

TEST(Simplify, KeepsSurfacesSoundAndMovesThemToOneSide) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const RandomGrid random(seed);
    const GridSurface surface = grid_surface(random.edges, Diagonals::kLarger);
    const double before = volume_of(surface.positions, surface.triangles);
    for (const auto side : {SimplifyOptions::Side::kInward, SimplifyOptions::Side::kOutward}) {
      const IndexedSurface simple =
          simplify({surface.positions, surface.triangles},
                   {.side = side, .tolerance = 0.04, .box = random.grid.box(), .spacing = 0.08});
      EXPECT_LT(simple.triangles.size(), surface.triangles.size());
      expect_sound(simple.positions, simple.triangles);
      for (const Vec3& p : simple.positions)
        for (int k = 0; k < 3; ++k)
          EXPECT_TRUE(random.grid.box().low[k] <= p[k] && p[k] <= random.grid.box().high[k]);
      const double after = volume_of(simple.positions, simple.triangles);
      if (side == SimplifyOptions::Side::kInward) {
        EXPECT_LT(after, before);
      } else {
        EXPECT_GT(after, before);
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::detail
