// The guarantee of penumbra volumes: no point that is not fully lit is outside. For every caster of
// data/scenes, half of the points are within 1e-3 of the volume's surface, half anywhere in the scene's box.
// 4,000 points a caster by default; PENUMBRA_LONG=1 in the environment asks for 100,000.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/containment_check.h"
#include "tests/volumes/scene_caster.h"

namespace penumbra {
namespace {

constexpr std::uint64_t kSeed = 36;

int point_count() {
  return std::getenv("PENUMBRA_LONG") ? 100'000 : 4'000;
}

ShadowMesh build_timed(const TriangleMesh& mesh, const DiskLight& light, const Bounds& box,
                       double& milliseconds) {
  VolumeOptions options;
  options.extrude.bound_center = box.center();
  options.extrude.bound_radius = box.radius();
  const auto start = std::chrono::steady_clock::now();
  ShadowMesh volume = build_shadow_volumes(mesh, light, options).penumbra;
  milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return volume;
}

void check(const std::string& name, const TriangleMesh& mesh, const DiskLight& light, const Bounds& box,
           int points) {
  double milliseconds = 0.0;
  const ShadowMesh volume = build_timed(mesh, light, box, milliseconds);
  ASSERT_EQ(volume.guarantee, Guarantee::kContains);
  testing::ContainmentCheck check(mesh, light, volume, box, kSeed);
  EXPECT_TRUE(check.is_sum_of_convex_cells());
  check.run(points);
  std::cout << "  " << name << ": " << check.figures().text() << ", built in " << milliseconds << " ms\n";
  EXPECT_GT(check.figures().shaded(), points / 100) << "too few points in shadow to mean anything";
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScene, NoPointInShadowIsOutsideOfThePenumbraVolume) {
  const testing::SceneCaster scene = testing::load_scene(GetParam());
  check(scene.name, scene.mesh, scene.light, scene.scene, point_count());
}

INSTANTIATE_TEST_SUITE_P(Data, EveryScene, ::testing::ValuesIn(testing::scene_names()),
                         [](const auto& scene) {
                           std::string name = scene.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// A convex caster of many vertices, most of which are left out of the far end.
TEST(PenumbraOfAFineSphere, ContainsItsShadow) {
  Bounds box;
  box.add(Vec3(-6, 0, -6));
  box.add(Vec3(6, 10, 6));
  for (const double radius : {0.0001, 0.8, 3.5}) {
    check("fine sphere", make_icosphere({-0.3, 5, 0.1}, 1.0, 5), DiskLight{{0, 10, 0}, {0.1, -1, 0}, radius},
          box, 4000);
  }
}

TEST(PenumbraOfAFineSphere, ContainsItsShadowWhenTinyAndFarFromTheAxis) {
  const Vec3 center(900, 5, 0);
  Bounds box;
  box.add(center - Vec3(1e-6));
  box.add(center + Vec3(1e-6));
  const DiskLight light{{0, 10, 0}, {0, -1, 0}, 1e-9};
  check("tiny sphere", make_icosphere(center, 1e-6, 3), light, box, 2000);
}

/// Lights that cut through the caster or touch it: clipped triangles, distance cut-offs and half-space cells.
TEST(PenumbraNearTheLight, ContainsTheShadowOfFacesThatCrossItsPlane) {
  const TriangleMesh mesh =
      testing::read_moved(std::filesystem::path(PENUMBRA_DATA) / "scenes" / "torus.off", Vec3(0.0));
  const Bounds box = bounds_of(mesh.positions());
  const Vec3 c = box.center();
  for (const Vec3& at : {c, Vec3(box.high.x, c.y, c.z), Vec3(c.x, box.high.y, c.z), box.high}) {
    check("torus and a light at " + std::to_string(at.x), mesh, DiskLight{at, {0.1, -1, 0.2}, 0.1}, box,
          2000);
  }
}

}  // namespace
}  // namespace penumbra
