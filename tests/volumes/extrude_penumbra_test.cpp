#include "penumbra/volumes/extrude.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/shapes.h"
#include "tests/volumes/scene_caster.h"
#include "tests/volumes/shadow_oracle.h"
#include "tests/volumes/volume_support.h"

namespace penumbra {
namespace {

using testing::build;
using testing::kLight;
using testing::knife;
using testing::unmatched;
using testing::winding_at;

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

}  // namespace
}  // namespace penumbra
