#include "penumbra/volumes/checks/validate.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/convex_umbra.h"
#include "tests/volumes/checks/soup.h"
#include "tests/volumes/scene_caster.h"

namespace penumbra {
namespace {

const DiskLight kLight{{0, 10, 0}, {0, -1, 0}, 0.8};

using testing::Soup;

SurfaceFindings check(const Soup& soup, std::size_t most = 1000) {
  return check_surface(soup.positions, soup.triangles, {most});
}

TEST(CheckSurface, ABoxIsASolid) {
  const SurfaceFindings f = check(Soup(make_box({0, 0, 0}, Vec3(1))));
  EXPECT_TRUE(f.closed());
  EXPECT_TRUE(f.self_intersections.empty());
  EXPECT_TRUE(f.degenerate.empty());
  EXPECT_EQ(f.pieces, 1u);
  EXPECT_EQ(f.solid_pieces, 1u);
  EXPECT_TRUE(f.bounds_a_volume);
}

TEST(CheckSurface, AnInsideOutBoxBoundsNoVolume) {
  Soup box(make_box({0, 0, 0}, Vec3(1)));
  box.turn_round();
  EXPECT_TRUE(check(box).closed());
  EXPECT_FALSE(check(box).bounds_a_volume);
}

TEST(CheckSurface, ACavityIsPartOfASolidOnlyTurnedInward) {
  Soup outer(make_box({0, 0, 0}, Vec3(1))), inner(make_box({0, 0, 0}, Vec3(0.5)));
  Soup filled = outer;
  filled.add(inner);
  EXPECT_FALSE(check(filled).bounds_a_volume);
  inner.turn_round();
  outer.add(inner);
  EXPECT_EQ(check(outer).pieces, 2u);
  EXPECT_EQ(check(outer).solid_pieces, 1u);  // the cavity alone is inside out
}

TEST(CheckSurface, CountsOpenAndTurnedEdges) {
  Soup box(make_box({0, 0, 0}, Vec3(1)));
  std::swap(box.triangles[0][0], box.triangles[0][1]);
  EXPECT_EQ(check(box).unmatched_half_edges, 6u);
  EXPECT_FALSE(check(box).bounds_a_volume);
  box.triangles.erase(box.triangles.begin());
  EXPECT_EQ(check(box).unmatched_half_edges, 3u);
}

TEST(CheckSurface, ListsCrossingsByTriangles) {
  Soup two(make_triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0}));
  two.add(Soup(make_triangle({0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0})));
  const SurfaceFindings f = check(two);
  ASSERT_EQ(f.self_intersections.size(), 1u);
  EXPECT_EQ(f.self_intersections[0], (std::array<std::uint32_t, 2>{0, 1}));
  EXPECT_EQ(f.crossed_pieces, 0u);
}

/// By how many corners two triangles share: what is more than the shared part is an intersection.
TEST(CheckSurface, SharedCornersAndSidesAreNoCrossing) {
  const auto pairs = [](std::vector<Vec3> p, std::vector<IndexedTriangle> t) {
    return check_surface(p, t).self_intersections.size();
  };
  const std::vector<Vec3> p{{0, 0, 0},       {1, 0, 0}, {0, 1, 0},    {0, -1, 0},
                            {0.25, 0.25, 0}, {0, 0, 1}, {0.1, 0.1, 1}};
  EXPECT_EQ(pairs(p, {{0, 1, 2}, {0, 3, 1}}), 0u);  // a side, flat
  EXPECT_EQ(pairs(p, {{0, 1, 2}, {1, 0, 4}}), 1u);  // a side, folded flat over it
  EXPECT_EQ(pairs(p, {{0, 1, 2}, {1, 0, 5}}), 0u);  // a side, at an angle
  EXPECT_EQ(pairs(p, {{0, 1, 2}, {0, 5, 3}}), 0u);  // a corner
  EXPECT_EQ(pairs(p, {{0, 1, 2}, {0, 4, 6}}), 1u);  // a corner, and a side that lies in it
  EXPECT_EQ(pairs(p, {{0, 1, 2}, {0, 2, 1}}),
            1u);  // opposite faces: CGAL's own test of volumes may crash on these
}

TEST(CheckSurface, OppositeFacesAndNonManifoldsDoNotReachCgal) {
  Soup box(make_box({0, 0, 0}, Vec3(1)));
  box.triangles.push_back(box.triangles[0]);
  box.triangles.push_back({box.triangles[0][0], box.triangles[0][2], box.triangles[0][1]});
  const SurfaceFindings f = check(box);
  EXPECT_TRUE(f.closed());
  EXPECT_EQ(f.self_intersections.size(), 3u);
  EXPECT_FALSE(f.bounds_a_volume);
}

/// CGAL's does_bound_a_volume alone accepts this.
TEST(CheckSurface, TwoCrossingBoxesBoundNoVolume) {
  Soup two(make_box({0, 0, 0}, Vec3(1)));
  two.add(Soup(make_box({0.5, 0.3, 0.2}, Vec3(1))));
  const SurfaceFindings f = check(two);
  EXPECT_EQ(f.solid_pieces, 2u);
  EXPECT_GT(f.self_intersections.size(), 0u);
  EXPECT_FALSE(f.bounds_a_volume);
  EXPECT_EQ(check(two, 3).self_intersections.size(), 3u);
  EXPECT_FALSE(check(two, 3).all_listed);
}

TEST(CheckSurface, NamesDegenerateTriangles) {
  const std::vector<Vec3> p{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<IndexedTriangle> t{{0, 1, 2}, {0, 0, 1}};
  EXPECT_EQ(check_surface(p, t).degenerate, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_FALSE(check_surface({}, {}).bounds_a_volume);
}

VolumeFindings validated(const TriangleMesh& mesh, const DiskLight& light) {
  const Classification classes = classify_faces(mesh, light);
  ExtrudeOptions options;
  options.bound_center = {0, 5, 0};
  options.bound_radius = 12.0;
  return validate(mesh, light, convex_umbra(mesh, light, classes, options),
                  extrude_penumbra(mesh, light, classes, options), options);
}

TEST(Validate, ConvexCastersAreGood) {
  for (const double radius : {0.0, 0.01, 0.8, 4.0}) {
    DiskLight light = kLight;
    light.radius = radius;
    for (const TriangleMesh& mesh :
         {make_box({0.3, 5, 0.2}, Vec3(1.0)), make_icosphere({-0.3, 5, 0.1}, 1.0, 2),
          make_cylinder({0, 5, 0}, 0.5, 1.0, 24)}) {
      const VolumeFindings f = validated(mesh, light);
      EXPECT_TRUE(f.good()) << radius;
      EXPECT_EQ(f.umbra_in_hard.points, 1000u);
      EXPECT_EQ(f.hard_in_penumbra.points, 1000u);
      EXPECT_EQ(f.umbra.pieces, 1u);
      EXPECT_EQ(f.penumbra.solid_pieces, 1u);
    }
  }
}

TEST(Validate, ATorusIsGoodWithAnEmptyUmbra) {
  const auto scene = testing::load_scene("torus-medium");
  const VolumeFindings f = validated(scene.mesh, scene.light);
  EXPECT_TRUE(f.good());
  EXPECT_EQ(f.umbra.triangles, 0u);
  EXPECT_EQ(f.penumbra.solid_pieces, f.penumbra.pieces);
  EXPECT_FALSE(f.penumbra.bounds_a_volume);  // cells overlap
}

TEST(Validate, FindsWhatIsOutside) {
  const TriangleMesh box = make_box({0, 5, 0}, Vec3(1.0));
  const Classification classes = classify_faces(box, kLight);
  ExtrudeOptions options;
  options.bound_center = {0, 5, 0};
  options.bound_radius = 12.0;
  const ShadowMesh penumbra = extrude_penumbra(box, kLight, classes, options);
  ShadowMesh moved = convex_umbra(box, kLight, classes, options);
  for (Vec3& p : moved.positions) p.x += 0.3;
  const VolumeFindings f = validate(box, kLight, moved, penumbra, options);
  EXPECT_FALSE(f.good());
  EXPECT_GT(f.umbra_in_hard.outside, 0u);
  EXPECT_TRUE(f.umbra_in_hard.example.has_value());
}

}  // namespace
}  // namespace penumbra
