#include "render/rays/ray_groups.h"

#include <gtest/gtest.h>

#include "tests/render/rays/ray_support.h"

namespace penumbra::detail {
namespace {

Scene scene_of(std::vector<TriangleMesh> meshes) {
  Scene scene;
  for (TriangleMesh& mesh : meshes) scene.objects.push_back({"object", std::move(mesh), Vec3(0.8), true});
  return scene;
}

std::vector<std::uint32_t> objects_of(const RayPartGroup& group) {
  std::vector<std::uint32_t> out;
  for (const RayPart& part : group.parts) out.push_back(part.object);
  return out;
}

/// Both as one mesh.
TriangleMesh together(std::span<const TriangleMesh> meshes) {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), mesh.positions().begin(), mesh.positions().end());
    for (const IndexedTriangle& t : mesh.triangles())
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return testing::mesh_of(positions, triangles);
}

TEST(RayGroups, ScenesOfDataHaveOne) {
  for (const char* name : {"armadillo-medium", "foliage-medium", "boxes-small", "building", "tree",
                           "speck-small", "decorativePlant-large", "triangle-medium"}) {
    const Scene scene = testing::data_scene(name);
    for (const bool casts : {true, false}) {
      const std::vector<RayPartGroup> groups = group_by_scale(scene, casts);
      EXPECT_LE(groups.size(), 1u) << name;
      for (const RayPartGroup& group : groups)
        for (const RayPart& part : group.parts) {
          EXPECT_TRUE(part.faces.empty()) << name << ": all faces";
          EXPECT_EQ(scene.objects[part.object].casts, casts);
        }
    }
  }
}

TEST(RayGroups, WhatIsLargeOrFarAwayStandsByItself) {
  const Scene scene = scene_of({make_plane(1e6), make_box({0, 0.5, 0}, Vec3(0.5)),
                                make_box({3, 0.5, 0}, Vec3(0.1)), make_box({1e6, 0.5, 0}, Vec3(0.5))});
  const std::vector<RayPartGroup> groups = group_by_scale(scene, true);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(objects_of(groups[0]), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(objects_of(groups[1]), std::vector<std::uint32_t>{3});
  EXPECT_EQ(objects_of(groups[2]), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(group_by_scale(scene, false).empty());
}

/// Every face is in one group, with its number.
TEST(RayGroups, PartsOfOneMeshAreToldApart) {
  const TriangleMesh parts[] = {make_plane(1e5, 2), make_box({0, 0.5, 0}, Vec3(0.5)),
                                make_icosphere({2, 0.5, 0}, 0.4, 1)};
  const Scene scene = scene_of({together(parts)});
  const TriangleMesh& mesh = scene.objects[0].mesh;
  const std::vector<RayPartGroup> groups = group_by_scale(scene, true);
  ASSERT_EQ(groups.size(), 2u);
  std::vector<int> times(mesh.triangles().size(), 0);
  for (const RayPartGroup& group : groups) {
    ASSERT_EQ(group.parts.size(), 1u);
    for (const std::uint32_t f : group.parts[0].faces) {
      ++times[f];
      for (const std::uint32_t v : mesh.triangles()[f])
        for (int k = 0; k < 3; ++k) {
          EXPECT_GE(mesh.positions()[v][k], group.bounds.low[k]);
          EXPECT_LE(mesh.positions()[v][k], group.bounds.high[k]);
        }
    }
  }
  EXPECT_EQ(times, std::vector<int>(times.size(), 1));
}

TEST(RayGroups, AreAtMostEight) {
  std::vector<TriangleMesh> boxes;
  for (int k = 0; k < 40; ++k)
    boxes.push_back(make_box(Vec3(std::pow(10.0, k % 20), 0, 0), Vec3(std::pow(4.0, k))));
  const Scene scene = scene_of(boxes);
  const std::vector<RayPartGroup> groups = group_by_scale(scene, true);
  EXPECT_LE(groups.size(), 8u);
  std::size_t parts = 0;
  for (const RayPartGroup& group : groups) parts += group.parts.size();
  EXPECT_EQ(parts, 40u);
}

/// Rays find faces of every group, the nearest first, and name them as the meshes do.
TEST(RayGroups, AreOneSceneToRays) {
  penumbra::testing::Random random(411);
  std::vector<TriangleMesh> separate{make_plane(1e6), make_box({0, 0.51, 0}, Vec3(0.5)),
                                     make_box({1e4, 301, 200}, Vec3(150, 300, 100)),
                                     make_box({0, 1.1e-3, 0.7}, Vec3(1e-3))};
  for (const bool one_mesh : {false, true}) {
    const std::vector<TriangleMesh> meshes = one_mesh ? std::vector{together(separate)} : separate;
    const Scene scene = scene_of(meshes);
    const RayScene rays(scene, 1);
    const oracle::Oracle oracle{std::span(meshes)};
    std::size_t hits[4] = {};
    for (int i = 0; i < 4'000; ++i) {
      const Vec3 x = Vec3(0, 1, 0) + random.direction() * random.spread(3.0, 3e3);
      const Vec3 targets[] = {
          random.point(5.0), {0, 1e-3, 0.7}, Vec3(1e4, 300, 200) + random.point(100.0), {0, 0.5, 0}};
      const Vec3 way = targets[i % 4] + random.point(1e-4) - x;
      const auto found = first_hit(rays, {{.point = x}, way, true});
      const auto expected = oracle.first_hit(x, way);
      ASSERT_EQ(found.has_value(), expected.has_value()) << i;
      if (!found) continue;
      ASSERT_EQ(found->object, expected->face.object) << i;
      ASSERT_EQ(found->face, index(expected->face.face)) << i;
      EXPECT_NEAR(found->distance, expected->distance, 1e-9 * expected->distance);
      ++hits[i % 4];
    }
    for (const std::size_t count : hits) EXPECT_GT(count, 300u);
  }
}

}  // namespace
}  // namespace penumbra::detail
