// Solids of data/scenes: sound surfaces, on the safe side as rays in double tell.
#include <gtest/gtest.h>

#include "tests/render/solids/solid_judge.h"
#include "tests/render/solids/sound_solid.h"

namespace penumbra {
namespace {

struct SolidScene {
  explicit SolidScene(const std::string& name)
      : scene(load_scene(std::filesystem::path(PENUMBRA_DATA) / "scenes" / (name + ".json")).scene),
        light(scene.lights.front().shape),
        bound(scene.bounds()) {
    for (const SceneObject& object : scene.objects)
      if (object.casts) {
        objects.push_back(object);
        meshes.push_back(object.mesh);
      }
    const Vec3 by(0.02 * scene.caster_bounds().radius());
    bound.low -= by;
    bound.high += by;
  }
  ShadowSolid solid(ShadowLevel::Kind kind) const {
    return extrude_solid(Casters(objects), light, {kind}, {.bound = bound});
  }

  Scene scene;
  LightShape light;
  Bounds bound;
  std::vector<SceneObject> objects;
  std::vector<TriangleMesh> meshes;
};

class Solids : public testing::TestWithParam<const char*> {};

TEST_P(Solids, AreSoundAndOnTheSafeSide) {
  const SolidScene s(GetParam());
  const oracle::Oracle oracle(s.meshes);
  const oracle::Light light = std::get<DiskLight>(s.light);
  for (const auto kind : {ShadowLevel::Kind::kUmbra, ShadowLevel::Kind::kPenumbra}) {
    const bool umbra = kind == ShadowLevel::Kind::kUmbra;
    SCOPED_TRACE(umbra ? "umbra" : "penumbra");
    const ShadowSolid solid = s.solid(kind);
    ASSERT_FALSE(solid.mesh.triangles.empty());
    expect_sound(solid.mesh);
    const CircularLight circular = require_circular(s.light, "test");
    SolidPoints points{
        .count = 100'000, .box = bounds_of(solid.mesh.positions), .near = solid.tolerance, .samples = 48};
    const SolidFigures safe = judge_solid(solid.mesh, umbra, oracle, light, circular, points);
    EXPECT_EQ(safe.wrong, 0u) << "worst " << safe.worst;
    // Few samples take points that see little of the light for hidden ones, and those that see nearly all for
    // lit ones.
    points.count = 6'000;
    points.samples = 1'024;
    const SolidFigures close = judge_solid(solid.mesh, umbra, oracle, light, circular, points);
    EXPECT_EQ(close.wrong, 0u) << "worst " << close.worst;
    EXPECT_GT(close.region, 400u);
    EXPECT_LE(static_cast<double>(umbra ? close.missed : close.surplus),
              0.03 * static_cast<double>(close.region));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Solids,
                         testing::Values("cube-small", "sphere-medium", "torus-small", "bunny-small"));

}  // namespace
}  // namespace penumbra
