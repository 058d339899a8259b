// Solids whose shape is known: levels in closed form, tips, tunnels, casters that join, and casters in the
// light's plane.
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <random>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"
#include "penumbra/render/solids/extrude_solid.h"
#include "tests/render/solids/random_scenes.h"
#include "tests/render/solids/solid_judge.h"
#include "tests/render/solids/sound_solid.h"

namespace penumbra {
namespace {

using Kind = ShadowLevel::Kind;

ShadowSolid solid_of(std::vector<TriangleMesh> casters, const LightShape& light, const ShadowLevel& level,
                     const SolidOptions& options) {
  return extrude_solid(Casters(casters), light, level, options);
}

/// The plane through the disk's center and the edge sees half of the disk.
TEST(SolidShapes, HalfOfTheLightBesideAHalfPlane) {
  const std::vector<Vec3> corners{{-3, 0, -3}, {0, 0, -3}, {0, 0, 3}, {-3, 0, 3}};
  const TriangleMesh plate = TriangleMesh::build(corners, std::vector<IndexedTriangle>{{0, 2, 1}, {0, 3, 2}});
  const DiskLight light{{0.3, 4.0, 0.0}, {0.0, -1.0, 0.0}, 0.5};
  const double h = 0.05;
  const ShadowSolid solid =
      solid_of({plate}, light, {Kind::kFraction, 0.5},
               {.tolerance = h, .bound = {Vec3(-3.5, -1.5, -3.5), Vec3(1.5, 0.5, 3.5)}});
  expect_sound(solid.mesh);
  const Vec3 across = glm::normalize(Vec3(4.0, -0.3, 0.0));  // of the plane, which holds the z axis
  double nearest = 1.0, farthest = 0.0;
  for (const Vec3& p : solid.mesh.positions) {
    if (std::abs(p.z) > 1.5 || p.x < -1.0) continue;  // the plate's other edges hide nothing more there
    if (p.y == -1.5 && glm::dot(across, p) < -2.0 * h) continue;  // inside of the cap
    nearest = std::min(nearest, std::abs(glm::dot(across, p)));
    if (p.y > -1.5 && p.y < -0.1) farthest = std::max(farthest, std::abs(glm::dot(across, p)));
  }
  EXPECT_LT(nearest, h);
  EXPECT_LT(farthest, h);
}

/// Below the sphere, on the axis, the sphere hides a disk of radius ρ = (D + d)R/√(d² - R²) around the
/// light's center. Returns the depth d at which ρ is a given radius.
double depth_where(double rho, double sphere, double distance) {
  double low = sphere, high = 100.0;
  for (int i = 0; i < 200; ++i) {
    const double d = 0.5 * (low + high);
    ((distance + d) * sphere / std::sqrt(d * d - sphere * sphere) > rho ? low : high) = d;
  }
  return low;
}

TEST(SolidShapes, LevelsAndTipBelowASphere) {
  const double sphere = 0.5, distance = 3.0, radius = 2.0, h = 0.03;
  const TriangleMesh ball = make_icosphere(Vec3(0.0), sphere, 5);
  const DiskLight light{{0.0, distance, 0.0}, {0.0, -1.0, 0.0}, radius};
  const Bounds bound{Vec3(-3.0), Vec3(3.0, 1.0, 3.0)};
  const std::pair<ShadowLevel, double> levels[] = {
      {{Kind::kUmbra}, depth_where(radius, sphere, distance)},
      {{Kind::kFraction, 0.5}, depth_where(radius * std::sqrt(0.5), sphere, distance)}};
  for (const auto& [level, depth] : levels) {
    const ShadowSolid solid = solid_of({ball}, light, level, {.tolerance = h, .bound = bound});
    expect_sound(solid.mesh);
    EXPECT_EQ(euler_characteristic(solid.mesh), 2);
    EXPECT_NEAR(bounds_of(solid.mesh.positions).low.y, -depth, h);
  }
}

TEST(SolidShapes, ATorusHasATunnelOfLight) {
  const TriangleMesh torus = make_torus(Vec3(0.0), 1.0, 0.3, 48, 24);
  const DiskLight light{{0.0, 5.0, 0.0}, {0.0, -1.0, 0.0}, 0.2};
  const SolidOptions options{.tolerance = 0.05, .bound = {Vec3(-2.0), Vec3(2.0)}};
  for (const Kind kind : {Kind::kUmbra, Kind::kPenumbra}) {
    const ShadowSolid solid = solid_of({torus}, light, {kind}, options);
    expect_sound(solid.mesh);
    EXPECT_EQ(euler_characteristic(solid.mesh), 0);
  }
}

TEST(SolidShapes, UmbrasOfTwoCastersJoin) {
  const TriangleMesh left = make_box(Vec3(-0.5, 0.0, 0.0), Vec3(0.5, 0.1, 0.5)),
                     right = make_box(Vec3(0.4, 0.5, 0.0), Vec3(0.5, 0.1, 0.5));
  const DiskLight light{{0.0, 4.0, 0.0}, {0.0, -1.0, 0.0}, 0.3};
  const ShadowSolid solid =
      solid_of({left, right}, light, {Kind::kUmbra}, {.tolerance = 0.04, .bound = {Vec3(-2.0), Vec3(2.0)}});
  expect_sound(solid.mesh);
  EXPECT_EQ(euler_characteristic(solid.mesh), 2);
  EXPECT_TRUE(SolidInside(solid.mesh).contains(Vec3(-0.01, -0.6, 0.0)));
}

TEST(SolidShapes, ACasterThroughTheLightsPlaneCastsInFrontOfIt) {
  const TriangleMesh post = make_box(Vec3(1.0, 1.0, 0.0), Vec3(0.2, 0.8, 0.2));
  const DiskLight light{{0.0, 1.2, 0.0}, {0.0, -1.0, 0.0}, 0.3};
  const SolidOptions options{.tolerance = 0.04, .bound = {Vec3(-3.0), Vec3(3.0)}};
  for (const Kind kind : {Kind::kUmbra, Kind::kPenumbra}) {
    const ShadowSolid solid = solid_of({post}, light, {kind}, options);
    ASSERT_FALSE(solid.mesh.triangles.empty());
    expect_sound(solid.mesh);
    EXPECT_LE(bounds_of(solid.mesh.positions).high.y, 1.2 + 0.1 * 0.04);
    EXPECT_TRUE(SolidInside(solid.mesh).contains(Vec3(1.5, 0.9, 0.0)));
  }
}

/// A turned box is convex but for rounding. What is convex within it has corners some units in the last place
/// apart.
TEST(SolidShapes, UmbrasOfTurnedBoxesHaveNoTrianglesOfTheSizeOfRounding) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const DiskLight light{{0.0, 10.0, 0.0}, {0.0, -1.0, 0.0}, 0.8};
  for (int i = 0; i < 100; ++i) {
    const Vec3 u = glm::normalize(Vec3(unit(random), unit(random), 1.0));
    const Vec3 v = glm::normalize(glm::cross(u, Vec3(unit(random), 1.0, unit(random))));
    std::vector<Vec3> corners;
    for (int k = 0; k < 8; ++k)
      corners.push_back(Vec3(0.0, 4.0, 0.0) + (k & 1 ? 0.3 : -0.3) * u + (k & 2 ? 0.3 : -0.3) * v +
                        (k & 4 ? 0.3 : -0.3) * glm::cross(u, v));
    const TriangleMesh body = TriangleMesh::build(corners, std::vector<IndexedTriangle>{{0, 1, 3},
                                                                                        {0, 3, 2},
                                                                                        {4, 6, 7},
                                                                                        {4, 7, 5},
                                                                                        {0, 4, 5},
                                                                                        {0, 5, 1},
                                                                                        {2, 3, 7},
                                                                                        {2, 7, 6},
                                                                                        {0, 2, 6},
                                                                                        {0, 6, 4},
                                                                                        {1, 5, 7},
                                                                                        {1, 7, 3}});
    const ShadowSolid solid =
        solid_of({body}, light, {Kind::kUmbra}, {.bound = {Vec3(-5.0, 0.0, -5.0), Vec3(5.0, 9.0, 5.0)}});
    expect_sound(solid.mesh);
    double shortest = 1.0;
    for (const IndexedTriangle& t : solid.mesh.triangles)
      for (int k = 0; k < 3; ++k)
        shortest = std::min(shortest,
                            glm::length(solid.mesh.positions[t[k]] - solid.mesh.positions[t[(k + 1) % 3]]));
    EXPECT_GT(shortest, 1e-11) << i;
  }
}

TEST(SolidShapes, HollowSolidsLeaveTheBodiesOut) {
  const TriangleMesh torus = make_torus(Vec3(0.0), 1.0, 0.3, 48, 24);
  const DiskLight light{{0.0, 5.0, 0.0}, {0.0, -1.0, 0.0}, 0.2};
  SolidOptions options{.tolerance = 0.05, .bound = {Vec3(-1.8), Vec3(1.8)}};
  const double body = torus.components().front().signed_volume;
  for (const Kind kind : {Kind::kUmbra, Kind::kPenumbra}) {
    options.hollow = false;
    const ShadowSolid whole = solid_of({torus}, light, {kind}, options);
    options.hollow = true;
    const ShadowSolid hollow = solid_of({torus}, light, {kind}, options);
    expect_sound(hollow.mesh);
    EXPECT_EQ(hollow.mesh.guarantee, Guarantee::kWithin);
    EXPECT_NEAR(whole.volume - hollow.volume, body, 0.1 * body);
    const SolidInside inside(hollow.mesh);
    EXPECT_FALSE(inside.contains(Vec3(1.0, 0.0, 0.0)));
    EXPECT_TRUE(inside.contains(Vec3(1.0, -0.6, 0.0)));
  }
}

// Points of the grid lie in the box's lower face: there is no way from them that the face does not touch.
TEST(SolidShapes, HollowWhereAFaceLiesInTheGrid) {
  const TriangleMesh box = make_box(Vec3(0.0), Vec3(6.0, 12.0, 12.0));
  const double far = 2.0 * glm::length(Vec3(6.0, 12.0, 12.0));
  const Bounds bound{Vec3(-6.0 - far, -12.0 - far, -12.0 - far), Vec3(6.0 + far, 12.0 + far, 12.0 + far)};
  const ShadowSolid solid = solid_of({box}, DistantLight{{0.0, -1.0, 0.0}, 0.5}, {Kind::kUmbra},
                                     {.tolerance = 0.51, .bound = bound, .hollow = true});
  expect_sound(solid.mesh);
  EXPECT_FALSE(SolidInside(solid.mesh).contains(Vec3(0.0)));
  EXPECT_TRUE(SolidInside(solid.mesh).contains(Vec3(0.5, -14.0, 0.3)));
}

TEST(SolidShapes, RandomScenesGiveSoundSolidsOrAreRefusedByName) {
  std::size_t made = 0;
  const char* more = std::getenv("PENUMBRA_SOLID_SCENES");  // 500, say
  const std::uint64_t scenes = more ? std::stoull(more) : 8;
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    const RandomSolidScene scene(seed);
    for (const Kind kind : {Kind::kUmbra, Kind::kPenumbra, Kind::kFraction}) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      try {
        const ShadowSolid solid = solid_of(scene.casters, scene.light, {kind}, {.tolerance = 0.08});
        if (solid.mesh.triangles.empty()) continue;
        ++made;
        expect_sound(solid.mesh);
      } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()), "");
      }
    }
  }
  EXPECT_GT(made, 12u);
}

TEST(SolidShapes, OptionsOutsideTheirDomainAreRefused) {
  const TriangleMesh ball = make_icosphere(Vec3(0.0), 0.5, 1);
  const DiskLight light{{0.0, 3.0, 0.0}, {0.0, -1.0, 0.0}, 0.3};
  EXPECT_THROW(solid_of({ball}, light, {Kind::kUmbra}, {.tolerance = -1.0}), UsageError);
  EXPECT_THROW(solid_of({ball}, light, {Kind::kFraction, 1.0}, {}), UsageError);
  EXPECT_THROW(solid_of({ball}, light, {Kind::kUmbra}, {.bound = {Vec3(-0.1), Vec3(0.1)}}), UsageError);
  EXPECT_THROW(solid_of({ball}, light, {Kind::kFraction, 0.5}, {.tolerance = 1e-5}), UsageError);
}

}  // namespace
}  // namespace penumbra
