#include "penumbra/volumes/extrude.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/tangent_planes.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/scene_caster.h"
#include "tests/volumes/shadow_oracle.h"
#include "tests/volumes/triangle_tree.h"

namespace penumbra {
namespace {

const DiskLight kLight{{0, 10, 0}, {0, -1, 0}, 0.8};

ShadowVolumes build(const TriangleMesh& mesh, const DiskLight& light, bool sheets = false) {
  VolumeOptions options;
  options.sheets = sheets;
  return build_shadow_volumes(mesh, light, options);
}

/// How often each directed half-edge is used more than its opposite.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> unmatched(
    const std::vector<IndexedTriangle>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const IndexedTriangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      ++count[{t[i], t[(i + 1) % 3]}];
      --count[{t[(i + 1) % 3], t[i]}];
    }
  }
  std::erase_if(count, [](const auto& entry) { return entry.second <= 0; });
  return count;
}

int winding_at(const ShadowMesh& volume, const DiskLight& light, const Vec3& x) {
  testing::RandomInputs random(1);
  const testing::TriangleTree tree(volume.positions, volume.triangles);
  return testing::winding_number(tree, x, light.center - light_frame(light).w, 0.1, random);
}

// ---- penumbra volumes
// -----------------------------------------------------------------------------------------------------

TEST(ExtrudePenumbra, OneCellForAConvexCaster) {
  for (const TriangleMesh& mesh : {make_box({0.3, 5, 0.2}, Vec3(0.8)), make_icosphere({-0.3, 5, 0.1}, 1.0, 5),
                                   make_cylinder({0, 5, 0}, 0.5, 1.0, 24)}) {
    const ShadowMesh volume = build(mesh, kLight).penumbra;
    EXPECT_EQ(volume.cells, 1u);
    EXPECT_TRUE(unmatched(volume.triangles).empty());
    EXPECT_EQ(volume.tags.size(), volume.triangles.size());
  }
}

TEST(ExtrudePenumbra, ClosedForEveryScene) {
  for (const char* name : {"torus-medium", "foliage-large", "boxes-small", "knot1-large"}) {
    const testing::SceneCaster scene = testing::load_scene(name);
    const ShadowMesh volume = build(scene.mesh, scene.light).penumbra;
    EXPECT_TRUE(unmatched(volume.triangles).empty()) << name;
    EXPECT_GT(volume.cells, 1u) << name;
  }
}

TEST(ExtrudePenumbra, HoldsTheBodyOfASolid) {
  const testing::SceneCaster scene = testing::load_scene("torus-medium");
  const ShadowMesh volume = build(scene.mesh, scene.light).penumbra;
  const testing::TriangleTree body(scene.mesh.positions(), scene.mesh.triangles());
  const testing::TriangleTree tree(volume.positions, volume.triangles);
  const Bounds box = bounds_of(scene.mesh.positions());
  testing::RandomInputs random(5);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                 random.uniform(box.low.z, box.high.z));
    if (testing::winding_number(body, x, scene.light.center, 0.01, random) < 1) continue;
    ++inside;
    ASSERT_GE(testing::winding_number(tree, x, scene.light.center + Vec3(0, 1, 0), 0.1, random), 1);
  }
  EXPECT_GT(inside, 100);
}

TEST(ExtrudePenumbra, PointLightGivesTheHardVolume) {
  const DiskLight point{{0, 10, 0}, {0, -1, 0}, 0.0};
  const ShadowMesh volume = build(make_box({0, 5, 0}, Vec3(1.0)), point).penumbra;
  EXPECT_EQ(winding_at(volume, point, {2.4, 0.1, 2.4}), 1);  // the top, y = 6, doubles its size at y = 2 ...
  EXPECT_EQ(winding_at(volume, point, {2.5, 0.1, 2.5}), 0);
}

TEST(ExtrudePenumbra, TheMarginOfTheShadowIsThatOfTheDisk) {
  // One triangle seen face on from the axis: at depth 2d the penumbra reaches the light's radius beyond the
  // shadow's edge.
  const TriangleMesh mesh = make_triangle({-1, 5, -1}, {-1, 5, 2}, {2, 5, -1});
  const ShadowMesh volume = build(mesh, kLight).penumbra;
  EXPECT_EQ(volume.cells, 1u);
  EXPECT_EQ(winding_at(volume, kLight, {-2.0 - 0.79, 0, 0}), 1);
  EXPECT_EQ(winding_at(volume, kLight, {-2.0 - 0.83, 0, 0}), 0);  // 16 corners: 2% of the radius
}

TEST(ExtrudePenumbra, NothingBehindTheLightCasts) {
  const ShadowMesh behind = build(make_box({0, 15, 0}, Vec3(1.0)), kLight).penumbra;
  EXPECT_EQ(behind.cells, 0u);
  EXPECT_TRUE(behind.triangles.empty());
  const ShadowMesh across = build(make_box({5, 10, 0}, Vec3(1.0)), kLight).penumbra;
  EXPECT_GT(across.cells, 0u);
  EXPECT_TRUE(unmatched(across.triangles).empty());
}

TEST(ExtrudePenumbra, ATouchedLightShadesTheHalfSpace) {
  const TriangleMesh mesh = make_triangle({-1, 10, -1}, {-1, 9, 2}, {2, 9, -1});
  const ShadowMesh volume = build(mesh, DiskLight{{-1, 10, -1}, {0, -1, 0}, 0.5}).penumbra;
  EXPECT_EQ(volume.triangles.size(), 12u);
}

TEST(ExtrudePenumbra, DegenerateFacesCastNothing) {
  const std::vector<Vec3> p{{0, 5, 0}, {1, 5, 0}, {3, 5, 0}};
  const std::vector<IndexedTriangle> t{{0, 1, 2}};
  EXPECT_EQ(build(TriangleMesh::build(p, t), kLight).penumbra.cells, 0u);
}

TEST(ExtrudePenumbra, IsTheSameEveryTime) {
  const testing::SceneCaster scene = testing::load_scene("knot1-medium");
  const ShadowMesh a = build(scene.mesh, scene.light).penumbra, b = build(scene.mesh, scene.light).penumbra;
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(ExtrudePenumbra, AsksAndStops) {
  const testing::SceneCaster scene = testing::load_scene("knot1-medium");
  VolumeOptions options;
  int calls = 0;
  double last = 0.0;
  options.extrude.progress = [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return ++calls < 3;
  };
  EXPECT_THROW(build_shadow_volumes(scene.mesh, scene.light, options), Cancelled);
  EXPECT_EQ(calls, 3);
}

/// A thin roof: two mixed faces meet in a knife edge under a large light, and no face looks at all of it. The
/// paper's rule finds no penumbra silhouette; ours a penumbra.
TriangleMesh knife() {
  const std::vector<Vec3> p{{-1, 5.6, 0}, {1, 5.6, 0},  {-1, 4, -0.1},
                            {1, 4, -0.1}, {-1, 4, 0.1}, {1, 4, 0.1}};
  const std::vector<IndexedTriangle> t{{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1},
                                       {2, 3, 5}, {2, 5, 4}, {0, 2, 4}, {1, 5, 3}};
  return TriangleMesh::build(p, t);
}

TEST(ExtrudePenumbra, KnifeEdgeWithoutAnAllFrontFace) {
  const DiskLight large{{0, 10, 0}, {0, -1, 0}, 4.0};
  const TriangleMesh mesh = knife();
  ASSERT_TRUE(mesh.is_closed());
  const ShadowVolumes v = build(mesh, large, true);
  EXPECT_EQ(v.classes.all_front, 0u);
  EXPECT_TRUE(v.silhouettes.penumbra.empty());
  EXPECT_EQ(v.penumbra.cells, 1u);
  EXPECT_FALSE(v.sheets.triangles.empty());
  testing::ShadowOracle oracle(mesh, large);
  testing::RandomInputs random(2);
  const testing::TriangleTree tree(v.penumbra.positions, v.penumbra.triangles);
  int shaded = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x(random.uniform(-8, 8), random.uniform(0, 5), random.uniform(-8, 8));
    if (!oracle.is_partly_hidden(x)) continue;
    ++shaded;
    ASSERT_GE(testing::winding_number(tree, x, {0, 11, 0}, 0.1, random), 1);
  }
  EXPECT_GT(shaded, 300);
}

/// The same face by face: mixed faces alone have to do it.
TEST(ExtrudePenumbra, MixedFacesHaveCells) {
  const DiskLight large{{0, 10, 0}, {0, -1, 0}, 4.0};
  const TriangleMesh mesh = knife();
  VolumeOptions options;
  options.extrude.split_convex = false;
  EXPECT_EQ(build_shadow_volumes(mesh, large, options).penumbra.cells, 1u);
  options.extrude.merge_faces = false;
  const ShadowMesh volume = build_shadow_volumes(mesh, large, options).penumbra;
  EXPECT_EQ(volume.cells, 6u);  // of 8 faces the two of the bottom look away
  testing::ShadowOracle oracle(mesh, large);
  for (const Vec3& x : {Vec3(0, 3, 0), Vec3(0.5, 5, 0.3), Vec3(-3, 2, 2), Vec3(0, 1, -4)}) {
    ASSERT_TRUE(oracle.is_partly_hidden(x));
    EXPECT_GE(winding_at(volume, large, x), 1);
  }
}

/// A square slab with a small hole: 16 outer and inner corners. Below the hole some light is missing
/// everywhere, and the volume says so (loops of facets do not: the loops of the hole wind against those of
/// the rim).
TriangleMesh slab_with_hole(double half, double hole, double low, double high) {
  std::vector<Vec3> p;
  for (const double y : {low, high}) {
    for (const double r : {half, hole}) {
      for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        p.push_back(Vec3(r * x, y, r * z));
    }
  }
  std::vector<IndexedTriangle> t;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    t.push_back({a, b, c});
    t.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    quad(i, j, 4 + j, 4 + i);            // below, ring from outer to inner
    quad(8 + j, 8 + i, 12 + i, 12 + j);  // above
    quad(j, i, 8 + i, 8 + j);            // outside
    quad(4 + i, 4 + j, 12 + j, 12 + i);  // the hole
  }
  return TriangleMesh::build(p, t);
}

TEST(ExtrudePenumbra, SlabWithASmallHole) {
  const TriangleMesh mesh = slab_with_hole(1.0, 0.05, 4.9, 5.1);
  ASSERT_TRUE(mesh.is_closed());
  const DiskLight light{{0, 10, 0}, {0, -1, 0}, 1.0};
  const ShadowMesh volume = build(mesh, light).penumbra;
  testing::ShadowOracle oracle(mesh, light);
  for (const Vec3& x :
       {Vec3(0.001, 3, 0.002), Vec3(0.01, 0.3, 0.02), Vec3(0.05, 4.5, 0), Vec3(0.003, 4.8, 0.001)}) {
    ASSERT_TRUE(oracle.is_partly_hidden(x));
    EXPECT_GE(winding_at(volume, light, x), 1);
  }
}

// ---- sheets
// ---------------------------------------------------------------------------------------------------------------

/// Penumbra triangles of the sheets; half-edges that stay open must join two far points, or two vertices of
/// the caster.
void expect_closed_sheets(const TriangleMesh& mesh, const DiskLight& light, const std::string& what) {
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

TEST(ExtrudeSheets, FacetsLieInTangentPlanesAndFaceAwayFromTheirVolume) {
  const auto scene = testing::load_scene("cube-medium");
  const ShadowMesh sheets = build(scene.mesh, scene.light, true).sheets;
  const Vec3 body = bounds_of(scene.mesh.positions()).center();
  const LightFrame frame = light_frame(scene.light);
  for (std::size_t i = 0; i < sheets.triangles.size(); ++i) {
    const Vec3 &a = sheets.positions[sheets.triangles[i][0]], &b = sheets.positions[sheets.triangles[i][1]],
               &c = sheets.positions[sheets.triangles[i][2]];
    const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
    const double center = glm::dot(n, scene.light.center - a),
                 reach = scene.light.radius * glm::length(glm::cross(n, frame.w));
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

TEST(ExtrudeSheets, ATriangleHasThreeFacetsOfEachKind) {
  const ShadowMesh sheets =
      build(make_triangle({-1, 5, -1}, {-1, 5.3, 2}, {2, 5.1, -1}), kLight, true).sheets;
  std::map<ShadowKind, int> kinds;
  for (const ShadowTag& tag : sheets.tags) ++kinds[tag.kind];
  EXPECT_EQ(kinds[ShadowKind::kPenumbraFacet], 6);
  EXPECT_EQ(kinds[ShadowKind::kUmbraFacet], 6);
  EXPECT_GE(kinds[ShadowKind::kPenumbraCone], 16);
}

// ---- options, merging, writing
// ----------------------------------------------------------------------------------------------

TEST(BuildShadowVolumes, RefusesWhatItCannotUse) {
  const TriangleMesh cube = make_box(Vec3(0.0), Vec3(1.0));
  EXPECT_THROW(build_shadow_volumes(TriangleMesh(), kLight), MeshError);
  VolumeOptions options;
  options.extrude.cone_segments = 2;
  EXPECT_THROW(build_shadow_volumes(cube, kLight, options), UsageError);
  options.extrude.cone_segments = 3;
  EXPECT_NO_THROW(build_shadow_volumes(cube, kLight, options));
  options.extrude.bound_radius = -1.0;
  EXPECT_THROW(build_shadow_volumes(cube, kLight, options), UsageError);
}

TEST(BuildShadowVolumes, RefusesOptionsEvenWhereNothingIsExtruded) {
  VolumeOptions options{.penumbra = false, .umbra = false};
  options.extrude.cone_segments = 2;
  EXPECT_THROW(build_shadow_volumes(make_box(Vec3(0.0), Vec3(1.0)), kLight, options), UsageError);
}

TEST(BuildShadowVolumes, MakesThePenumbraAndTheExactUmbraUnlessToldOtherwise) {
  const TriangleMesh box = make_box({0, 5, 0}, Vec3(1.0));
  const ShadowVolumes v = build_shadow_volumes(box, kLight);
  EXPECT_TRUE(v.sheets.triangles.empty());
  EXPECT_FALSE(v.penumbra.triangles.empty());
  EXPECT_EQ(v.penumbra.guarantee, Guarantee::kContains);
  EXPECT_EQ(v.umbra.guarantee, Guarantee::kExact);
  const ShadowMesh umbra = convex_umbra(box, kLight, v.classes);
  EXPECT_FALSE(umbra.triangles.empty());
  EXPECT_EQ(v.umbra.positions, umbra.positions);
  EXPECT_EQ(v.umbra.triangles, umbra.triangles);
}

std::vector<std::string> stage_names(const VolumeOptions& options) {
  std::vector<std::string> names;
  for (const StageTime& stage :
       build_shadow_volumes(make_box({0, 5, 0}, Vec3(1.0)), kLight, options).stages) {
    EXPECT_GE(stage.milliseconds, 0.0);
    names.push_back(stage.name);
  }
  return names;
}

TEST(BuildShadowVolumes, TimesTheStagesThatItRuns) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(stage_names({.penumbra = false, .umbra = false}), (Names{"classify", "silhouettes"}));
  EXPECT_EQ(stage_names({.sheets = true}), (Names{"classify", "silhouettes", "sheets", "penumbra", "umbra"}));
}

TEST(BuildShadowVolumes, WithoutProductsStillClassifiesAndFindsSilhouettes) {
  const TriangleMesh box = make_box({0, 5, 0}, Vec3(1.0));
  const ShadowVolumes v = build_shadow_volumes(box, kLight, {.penumbra = false, .umbra = false});
  EXPECT_EQ(v.classes.faces, classify_faces(box, kLight).faces);
  EXPECT_EQ(v.silhouettes.band, find_silhouettes(box, v.classes).band);
  for (const ShadowMesh* mesh : {&v.sheets, &v.penumbra, &v.umbra}) {
    EXPECT_TRUE(mesh->positions.empty());
    EXPECT_EQ(mesh->guarantee, Guarantee::kNone);
  }
}

TEST(BuildShadowVolumes, ProgressRunsOnceFromNothingToAll) {
  std::vector<double> fractions;
  VolumeOptions options{.sheets = true};
  options.extrude.progress = [&](double fraction) {
    fractions.push_back(fraction);
    return true;
  };
  build_shadow_volumes(make_box({0, 5, 0}, Vec3(1.0)), kLight, options);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
}

ShadowMesh two_objects() {
  VolumeOptions options;
  std::vector<ShadowMesh> parts;
  for (std::uint32_t object = 0; object < 2; ++object) {
    options.extrude.object = object;
    parts.push_back(
        build_shadow_volumes(make_box({3.0 * object, 5, 0}, Vec3(0.5)), kLight, options).penumbra);
  }
  return merge(parts);
}

TEST(Merge, KeepsTagsAndGuarantee) {
  const ShadowMesh both = two_objects();
  EXPECT_EQ(both.cells, 2u);
  EXPECT_EQ(both.guarantee, Guarantee::kContains);
  EXPECT_EQ(both.tags.front().object, 0u);
  EXPECT_EQ(both.tags.back().object, 1u);
  EXPECT_TRUE(unmatched(both.triangles).empty());
  ShadowMesh exact;
  exact.guarantee = Guarantee::kExact;
  EXPECT_EQ(merge(std::vector{exact, exact}).guarantee, Guarantee::kContained);
  EXPECT_EQ(merge(std::vector{exact}).guarantee, Guarantee::kExact);
}

TEST(WriteShadowMesh, PlyReadsBackWithTheSameDoubles) {
  const ShadowMesh mesh = two_objects();
  const auto path = std::filesystem::temp_directory_path() / "penumbra_shadow_mesh_test.ply";
  write_shadow_mesh(path, mesh);
  const PolygonSoup soup = read_polygon_soup(path);
  EXPECT_EQ(soup.positions, mesh.positions);
  EXPECT_EQ(soup.polygon_count(), mesh.triangles.size());
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const std::size_t record = 1 + 3 * 4 + 1 + 4 + 4,
                    body = mesh.positions.size() * 24 + mesh.triangles.size() * record;
  const std::size_t header = bytes.find("end_header\n") + 11;
  ASSERT_EQ(bytes.size(), header + body);
  EXPECT_EQ(bytes[bytes.size() - 4], 1);  // object of the last triangle
  EXPECT_EQ(bytes[header + mesh.positions.size() * 24 + 13], static_cast<char>(mesh.tags[0].kind));
  std::filesystem::remove(path);
}

TEST(WriteShadowMesh, ObjHasOneGroupPerObjectAndKind) {
  const ShadowMesh mesh = two_objects();
  const auto path = std::filesystem::temp_directory_path() / "penumbra_shadow_mesh_test.obj";
  write_shadow_mesh(path, mesh);
  EXPECT_EQ(read_polygon_soup(path).positions, mesh.positions);
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  for (const char* group :
       {"g object_0_cell\n", "g object_0_far_cap\n", "g object_1_cell\n", "g object_1_far_cap\n"}) {
    EXPECT_NE(text.str().find(group), std::string::npos) << group;
  }
  std::filesystem::remove(path);
  EXPECT_THROW(write_shadow_mesh("x.stl", mesh), UsageError);
  EXPECT_THROW(write_shadow_mesh("/nonexistent/folder/x.ply", mesh), SystemError);
}

}  // namespace
}  // namespace penumbra
