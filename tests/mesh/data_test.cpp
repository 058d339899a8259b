// The meshes in data/ are what data/meshes/README.md and data/scenes/README.md say, and the regressions stay
// mended.
#include <gtest/gtest.h>

#include <cmath>

#include "penumbra/mesh/inspect.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

const std::filesystem::path kData = PENUMBRA_DATA;

struct Expected {
  const char* file;
  std::size_t faces, components, closed_components, boundary_edges, non_manifold_edges, misoriented_edges;
};

std::ostream& operator<<(std::ostream& out, const Expected& expected) {
  return out << expected.file;
}

class DataMesh : public testing::TestWithParam<Expected> {};

TEST_P(DataMesh, IsAsDescribed) {
  const Expected& expected = GetParam();
  const TriangleMesh mesh = read_mesh(kData / expected.file);
  test::expect_sound(mesh);
  const MeshFindings findings = inspect(mesh);
  EXPECT_EQ(findings.faces, expected.faces);
  EXPECT_EQ(findings.components, expected.components);
  EXPECT_EQ(findings.closed_components, expected.closed_components);
  EXPECT_EQ(findings.closed, expected.components == expected.closed_components);
  EXPECT_EQ(findings.build.non_manifold_edges, expected.non_manifold_edges);
  EXPECT_EQ(findings.build.misoriented_edges, expected.misoriented_edges);
  EXPECT_EQ(findings.boundary_edges, expected.boundary_edges);
  EXPECT_EQ(findings.build.welded_vertices, 0u);
  EXPECT_TRUE(findings.build.degenerate.empty());
  EXPECT_TRUE(findings.build.duplicates.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, DataMesh,
    testing::Values(Expected{"meshes/bunny.ply", 3674, 1, 1, 0, 0, 0},       //
                    Expected{"meshes/homer.ply", 9856, 1, 1, 0, 0, 0},       //
                    Expected{"meshes/fandisk.ply", 12946, 1, 1, 0, 0, 0},    //
                    Expected{"meshes/knot1.ply", 6400, 1, 1, 0, 0, 0},       //
                    Expected{"meshes/armadillo.ply", 52000, 1, 1, 0, 0, 0},  //
                    Expected{"meshes/refined_elephant.ply", 88928, 1, 1, 0, 0, 0},
                    Expected{"meshes/elephant-with-holes.ply", 4463, 1, 0, 1353, 0, 0},
                    // Each misoriented edge makes two boundary edges.
                    Expected{"meshes/blobby-shuffled.ply", 4050, 1119, 0, 2 * 3069, 0, 3069},
                    // 39 edges have one face; 88 have four, which are joined in pairs.
                    Expected{"meshes/snowden_lo.ply", 37629, 31, 28, 39, 88, 0},
                    Expected{"meshes/decorativePlant.ply", 63428, 2229, 1920, 7488, 0, 0},
                    Expected{"meshes/doll-house.ply", 3994, 214, 185, 210, 0, 0},
                    Expected{"meshes/dog-house.ply", 388, 8, 8, 0, 0, 0}));

INSTANTIATE_TEST_SUITE_P(Scenes, DataMesh,
                         testing::Values(Expected{"scenes/boxes.off", 24, 2, 2, 0, 0, 0},
                                         Expected{"scenes/cube.off", 12, 1, 1, 0, 0, 0},
                                         Expected{"scenes/floor.off", 12, 1, 1, 0, 0, 0},
                                         Expected{"scenes/foliage.off", 200, 200, 0, 600, 0, 0},
                                         Expected{"scenes/speck.off", 12, 1, 1, 0, 0, 0},
                                         Expected{"scenes/sphere.off", 320, 1, 1, 0, 0, 0},
                                         Expected{"scenes/torus.off", 576, 1, 1, 0, 0, 0},
                                         Expected{"scenes/triangle.off", 1, 1, 0, 3, 0, 0}));

struct Measured {
  const char* file;
  std::size_t faces;
  double area, volume;  ///< volume 0: open
};

std::ostream& operator<<(std::ostream& out, const Measured& measured) {
  return out << measured.file;
}

class RegressionMesh : public testing::TestWithParam<Measured> {};

TEST_P(RegressionMesh, HasItsAreaAndVolume) {
  const Measured& expected = GetParam();
  const LoadedMesh loaded = load_mesh(kData / "regressions" / "meshes" / expected.file);
  test::expect_sound(loaded.mesh);
  const MeshFindings findings = inspect(loaded);
  EXPECT_EQ(findings.faces, expected.faces);
  EXPECT_DOUBLE_EQ(findings.surface_area, expected.area);
  EXPECT_DOUBLE_EQ(findings.signed_volume, expected.volume);
  EXPECT_EQ(findings.closed, expected.volume != 0.0);
}

INSTANTIATE_TEST_SUITE_P(Meshes, RegressionMesh,
                         testing::Values(Measured{"good-concave-l.obj", 4, 6, 0},       //
                                         Measured{"good-bridged-hole.obj", 8, 24, 0},   //
                                         Measured{"good-comb.ply", 10, 14, 0},          //
                                         Measured{"good-dart-quad.obj", 2, 1.5, 0},     //
                                         Measured{"good-vox-bars1.obj", 24, 12, 2},     //
                                         Measured{"good-vox-bars3.obj", 56, 28, 6},     //
                                         Measured{"good-vox-twist.obj", 64, 32, 6},     //
                                         Measured{"good-vox-rand0.obj", 344, 172, 36},  //
                                         Measured{"good-vox-rand1.obj", 400, 200, 43},  //
                                         Measured{"good-off-glued-counts.off", 4, 1.5 + std::sqrt(3) / 2,
                                                  1.0 / 6},
                                         Measured{"good-tristrips-ascii.ply", 12, 6, 1},               //
                                         Measured{"good-stl-binary-solid-spare-bytes.stl", 12, 6, 1},  //
                                         Measured{"good-ply-ascii-nan-unused.ply", 12, 6, 1},          //
                                         Measured{"good-ply-ascii-nan-quality-msvc.ply", 12, 6, 1},    //
                                         Measured{"good-ply-ascii-bom.ply", 12, 6, 1}));

/// Each file there is a mesh or a clear error, as its name says.
TEST(RegressionMeshes, AreMeshesOrErrors) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kData / "regressions" / "meshes")) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    if (name.starts_with("good-")) {
      test::expect_sound(read_mesh(entry.path()));
      ++count;
    } else if (name.starts_with("bad-")) {
      test::mesh_error_of([&] { read_mesh(entry.path()); });
      ++count;
    }
  }
  EXPECT_GT(count, 0u);
}

}  // namespace
}  // namespace penumbra
