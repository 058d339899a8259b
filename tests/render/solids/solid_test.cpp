// Solids of data/scenes: sound surfaces, on the safe side as rays in double tell.
#include <gtest/gtest.h>

#include "penumbra/volumes/checks/validate.h"
#include "tests/render/solids/solid_judge.h"

namespace penumbra {
namespace {

struct SolidScene {
  explicit SolidScene(const std::string& name)
      : scene(load_scene(std::string(PENUMBRA_DATA) + "/scenes/" + name + ".json").scene),
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

void expect_sound(const ShadowMesh& mesh) {
  ASSERT_FALSE(mesh.triangles.empty());
  const SurfaceFindings f = check_surface(mesh.positions, mesh.triangles);
  EXPECT_TRUE(f.closed());
  EXPECT_TRUE(f.degenerate.empty());
  EXPECT_TRUE(f.self_intersections.empty());
  EXPECT_TRUE(f.bounds_a_volume);
  EXPECT_TRUE(TriangleMesh::build(mesh.positions, mesh.triangles).is_closed());
}

class Solids : public testing::TestWithParam<const char*> {};

TEST_P(Solids, AreSoundAndOnTheSafeSide) {
  const SolidScene s(GetParam());
  const oracle::Oracle oracle(s.meshes);
  const oracle::Light light = std::get<DiskLight>(s.light);
  for (const auto kind : {ShadowLevel::Kind::kUmbra, ShadowLevel::Kind::kPenumbra}) {
    const bool umbra = kind == ShadowLevel::Kind::kUmbra;
    SCOPED_TRACE(umbra ? "umbra" : "penumbra");
    const ShadowSolid solid = s.solid(kind);
    expect_sound(solid.mesh);
    const SolidFigures f = judge_solid(
        solid.mesh, umbra, oracle, light, require_circular(s.light, "test"),
        {.count = 20'000, .box = bounds_of(solid.mesh.positions), .near = solid.tolerance, .samples = 64});
    EXPECT_EQ(f.wrong, 0u) << "worst " << f.worst;
    EXPECT_GT(f.region, 1'000u);
    EXPECT_LE(static_cast<double>(f.missed + f.surplus), 0.03 * static_cast<double>(f.region));
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Solids, testing::Values("cube-small", "bunny-small"));

}  // namespace
}  // namespace penumbra
