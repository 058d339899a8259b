// A volume that was written is closed when it is read again: its cells touch and overlap, so that many faces
// meet at edges that follow each other.
#include <gtest/gtest.h>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/volumes/volumes.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

const std::filesystem::path kData = PENUMBRA_DATA;

class ExportedVolumes : public testing::TestWithParam<const char*> {};

TEST_P(ExportedVolumes, AreClosedWhenReadAgain) {
  const TriangleMesh mesh = read_mesh(kData / GetParam());
  const double size = mesh.bounds().radius();
  const DiskLight light{.center = mesh.bounds().center() + size * Vec3(1.5, 4, 1),
                        .normal = Vec3(-1.5, -4, -1),
                        .radius = 0.4 * size};
  const ShadowVolumes shadow = build_shadow_volumes(mesh, light);
  const test::TemporaryFolder folder;
  for (const char* name : {"p.ply", "p.obj"}) {
    write_shadow_mesh(folder / name, shadow.penumbra);
    const TriangleMesh again = read_mesh(folder / name);
    test::expect_sound(again);
    EXPECT_TRUE(again.is_closed()) << name;
    EXPECT_GT(again.triangles().size(), mesh.triangles().size() / 8);
    EXPECT_EQ(again.report().flipped_components, 0u);
  }
  if (shadow.umbra.triangles.empty()) return;
  write_shadow_mesh(folder / "u.ply", shadow.umbra);
  EXPECT_TRUE(read_mesh(folder / "u.ply").is_closed());
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExportedVolumes,
                         testing::Values("meshes/bunny.ply", "meshes/dog-house.ply", "meshes/doll-house.ply",
                                         "scenes/torus.off", "scenes/foliage.off", "scenes/boxes.off",
                                         "regressions/meshes/good-vox-rand0.obj",
                                         "regressions/meshes/good-vox-bars3.obj"));

double umbra_volume(const TriangleMesh& mesh, std::size_t cells) {
  const DiskLight light{.center = {1, 9, 0.5}, .normal = {0, -1, 0}, .radius = 0.25};
  VolumeOptions options;
  options.extrude.bound_radius = 50.0;
  const ShadowMesh umbra = build_shadow_volumes(mesh, light, options).umbra;
  EXPECT_EQ(umbra.cells, cells);
  double volume = 0.0;
  const TriangleMesh built = TriangleMesh::build(umbra.positions, umbra.triangles);
  for (const Component& part : built.components()) {
    EXPECT_TRUE(part.closed);
    volume += part.signed_volume;
  }
  return volume;
}

TEST(ExportedVolumes, VoxelBarsHaveTheUmbraOfTheirConvexParts) {
  const TriangleMesh bars = read_mesh(kData / "regressions" / "meshes" / "good-vox-bars1.obj");
  ASSERT_EQ(bars.components().size(), 2u);
  double of_parts = 0.0;
  for (const Component& bar : bars.components()) {
    std::vector<IndexedTriangle> faces;
    for (const FaceId f : bar.faces) faces.push_back(bars.triangles()[index(f)]);
    const double part = umbra_volume(TriangleMesh::build(bars.positions(), faces), 1);
    EXPECT_GT(part, 1.0) << "the bar itself";
    of_parts += part;
  }
  EXPECT_NEAR(umbra_volume(bars, 2), of_parts, 1e-9 * of_parts);
}

}  // namespace
}  // namespace penumbra
