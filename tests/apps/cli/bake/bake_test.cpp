// penumbra bake: means over faces and around vertices, and the files.
#include "apps/cli/bake/bake.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/io/npy.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

/// A floor of two triangles, 2 by 2, and a plate high above whose shadow ends at x = `edge` under a light from above.
std::vector<SceneObject> half_shadowed(double edge) {
  const std::vector<Vec3> floor{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  const std::vector<Vec3> plate{{-9, 3, -9}, {edge, 3, -9}, {edge, 3, 9}, {-9, 3, 9}};
  const std::vector<IndexedTriangle> faces{{0, 2, 1}, {0, 3, 2}};
  return {{.name = "floor", .mesh = TriangleMesh::build(floor, faces)},
          {.name = "plate", .mesh = TriangleMesh::build(plate, faces)}};
}

const LightShape kAbove = DistantLight{{0, -1, 0}, 0.1};  // a penumbra of 1/200

/// Of the floor.
std::vector<float> baked(double edge, const apps::BakeOptions& options) {
  Scene scene;
  scene.objects = half_shadowed(edge);
  return apps::bake(Casters(scene.objects), apps::surface_of(scene, "floor"), kAbove, options);
}

TEST(Bake, FacesGetTheirShareOfLight) {
  const std::vector<float> lit = baked(0.0, {.side = 32});
  ASSERT_EQ(lit.size(), 2u);
  // The diagonal from (-1, -1) to (1, 1) leaves 3/4 of the first triangle on the lit side, and 1/4 of the second.
  EXPECT_NEAR(lit[0], 0.75, 0.02);
  EXPECT_NEAR(lit[1], 0.25, 0.02);
}

TEST(Bake, VerticesGetTheMeanAroundThem) {
  const std::vector<float> lit = baked(0.0, {.side = 32, .vertices = true});
  ASSERT_EQ(lit.size(), 4u);
  // Of the vertex at (1, -1), whose hat function on its one triangle is (x - z) / 2: the integral over x > 0 is 7/12, of 8/12 in all.
  EXPECT_NEAR(lit[1], 0.875, 0.02);
  EXPECT_NEAR(lit[3], 0.125, 0.02);
  EXPECT_NEAR(lit[0] + lit[2], 1.0, 0.02);
}

TEST(Bake, EverywhereLitIsOneAndHiddenIsZero) {
  for (const bool vertices : {false, true}) {
    for (const float value : baked(-8.0, {.side = 3, .vertices = vertices})) EXPECT_EQ(value, 1.0f);
    for (const float value : baked(8.0, {.side = 3, .vertices = vertices})) EXPECT_EQ(value, 0.0f);
  }
}

class BakeCommandTest : public ProgramTest {};

TEST_F(BakeCommandTest, WritesAMeshOrAnArray) {
  const std::string scene = PENUMBRA_DATA "/scenes/cube-medium.json";
  for (const char* to : {"faces", "vertices"}) {
    const Outcome mesh =
        run({"bake", scene, "--object", "cube.off", "--to", to, "--output", path("lit.ply")});
    ASSERT_EQ(mesh.code, 0) << mesh.err;
    EXPECT_EQ(read_mesh(path("lit.ply")).triangles().size(), 12u);
    EXPECT_NE(read_text(path("lit.ply")).find("property float visibility"), std::string::npos);
    const Outcome array = run({"bake", scene, "--object", "1", "--to", to, "--output", path("lit.npy")});
    ASSERT_EQ(array.code, 0) << array.err;
    EXPECT_NE(read_text(path("lit.npy")).find(to == std::string("faces") ? "(12,)" : "(8,)"),
              std::string::npos);
  }
  const Outcome none = run({"bake", scene, "--object", "cub", "--to", "faces", "--output", path("x.ply")});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("cube.off"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace penumbra::test
