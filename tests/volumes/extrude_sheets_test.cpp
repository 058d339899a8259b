#include "penumbra/volumes/extrude.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>

#include "penumbra/mesh/shapes.h"
#include "tests/volumes/scene_caster.h"
#include "tests/volumes/volume_support.h"

namespace penumbra {
namespace {

using testing::build;
using testing::kLight;
using testing::knife;
using testing::unmatched;

/// Penumbra triangles of the sheets; half-edges that stay open must join two far points, or two vertices of
/// the caster.
void expect_closed_sheets(const TriangleMesh& mesh, const CircularLight& light, const std::string& what) {
  SCOPED_TRACE(what);
  const ShadowVolumes v = build(mesh, light, true);
  std::vector<IndexedTriangle> penumbra;
  for (std::size_t i = 0; i < v.sheets.triangles.size(); ++i) {
    const ShadowKind kind = v.sheets.tags[i].kind;
    if (kind == ShadowKind::kPenumbraFacet || kind == ShadowKind::kPenumbraCone)
      penumbra.push_back(v.sheets.triangles[i]);
  }
  ASSERT_FALSE(penumbra.empty());
  const Bounds body = bounds_of(mesh.positions());
  const auto is_near = [&](std::uint32_t i) {
    return glm::length(v.sheets.positions[i] - body.center()) <= 1.01 * body.radius();
  };
  std::map<std::uint32_t, int> near_balance;
  std::size_t near = 0, far = 0;
  for (const auto& [edge, count] : unmatched(penumbra)) {
    ASSERT_EQ(count, 1);
    ASSERT_EQ(is_near(edge.first), is_near(edge.second)) << "the sheet is open along a ray";
    ++(is_near(edge.first) ? near : far);
    if (is_near(edge.first)) ++near_balance[edge.first], --near_balance[edge.second];
  }
  EXPECT_GT(far, 2u);
  for (const auto& [vertex, balance] : near_balance)
    ASSERT_EQ(balance, 0) << "the loop on the caster is open at " << vertex;
}

TEST(ExtrudeSheets, CloseForConvexCasters) {
  const auto cube = testing::load_scene("cube-medium"), sphere = testing::load_scene("sphere-medium");
  for (const double radius : {0.0, 0.05, 0.8, 2.5}) {
    DiskLight light = cube.light;
    light.radius = radius;
    expect_closed_sheets(cube.mesh, light, "cube, light " + std::to_string(radius));
    expect_closed_sheets(sphere.mesh, light, "sphere, light " + std::to_string(radius));
  }
  for (const double angle : {0.0, 0.53, 20.0, 120.0}) {
    const DistantLight sun{{0.3, -1, 0.2}, angle};
    expect_closed_sheets(cube.mesh, sun, "cube, sun of " + std::to_string(angle));
    expect_closed_sheets(sphere.mesh, sun, "sphere, sun of " + std::to_string(angle));
  }
  expect_closed_sheets(knife(), DistantLight{{0.01, -1, 0.005}, 40.0}, "knife edge under a sun");
  expect_closed_sheets(knife(), {{0.1, 10, 0.05}, {0, -1, 0}, 4.0}, "knife edge");
  expect_closed_sheets(make_cylinder({0.1, 5, 0}, 0.5, 1.0, 24), {{0.7, 10, 0.3}, {0.1, -1, 0}, 1.0},
                       "cylinder");
}

/// The penumbra of a needle whose tip points at a large light is that of its tip alone: a full cone and no
/// facet.
TEST(ExtrudeSheets, FullConeAtATip) {
  const std::vector<Vec3> p{{0, 6, 0}, {0.1, 4, 0}, {-0.05, 4, 0.1}, {-0.05, 4, -0.1}};
  const std::vector<IndexedTriangle> t{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  const ShadowVolumes v = build(TriangleMesh::build(p, t), {{0, 10, 0}, {0, -1, 0}, 3.0}, true);
  EXPECT_EQ(v.classes.all_front, 0u);
  std::map<ShadowKind, int> kinds;
  for (const ShadowTag& tag : v.sheets.tags) ++kinds[tag.kind];
  EXPECT_EQ(kinds[ShadowKind::kPenumbraCone], 16);
  EXPECT_EQ(kinds[ShadowKind::kPenumbraFacet], 0);
}

void expect_tangent_facets(const TriangleMesh& mesh, const CircularLight& light) {
  const ShadowMesh sheets = build(mesh, light, true).sheets;
  const Vec3 body = mesh.bounds().center();
  const LightFrame frame = light_frame(light);
  for (std::size_t i = 0; i < sheets.triangles.size(); ++i) {
    const Vec3 &a = sheets.positions[sheets.triangles[i][0]], &b = sheets.positions[sheets.triangles[i][1]],
               &c = sheets.positions[sheets.triangles[i][2]];
    const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
    const double center = glm::dot(n, way_to_center(light, a)),
                 reach = light.radius * glm::length(glm::cross(n, frame.w));
    EXPECT_LT(glm::dot(n, body - a), 0.0);
    switch (sheets.tags[i].kind) {
      case ShadowKind::kPenumbraFacet:
        EXPECT_NEAR(center, reach, 1e-9);
        break;
      case ShadowKind::kUmbraFacet:
        EXPECT_NEAR(center, -reach, 1e-9);
        break;
      default:
        EXPECT_GT(center, reach - 1e-9);  // a cone's corner triangles are outside of the true cone
    }
  }
}

TEST(ExtrudeSheets, FacetsLieInTangentPlanesAndFaceAwayFromTheirVolume) {
  const auto scene = testing::load_scene("cube-medium");
  expect_tangent_facets(scene.mesh, scene.light);
  expect_tangent_facets(scene.mesh, DistantLight{{0.3, -1, 0.2}, 0.53});
  expect_tangent_facets(scene.mesh, DistantLight{{0.3, -1, 0.2}, 30.0});
}

TEST(ExtrudeSheets, ATriangleHasThreeFacetsOfEachKind) {
  const ShadowMesh sheets =
      build(make_triangle({-1, 5, -1}, {-1, 5.3, 2}, {2, 5.1, -1}), kLight, true).sheets;
  std::map<ShadowKind, int> kinds;
  for (const ShadowTag& tag : sheets.tags) ++kinds[tag.kind];
  EXPECT_EQ(kinds[ShadowKind::kPenumbraFacet], 6);
  EXPECT_EQ(kinds[ShadowKind::kUmbraFacet], 6);
  EXPECT_GE(kinds[ShadowKind::kPenumbraCone], 16);
}

}  // namespace
}  // namespace penumbra
