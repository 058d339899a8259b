#include "mesh/topology/face_pairs.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/inspect.h"
#include "penumbra/mesh/shapes.h"
#include "tests/mesh/mesh_samples.h"
#include "tests/mesh/voxel_solids.h"

namespace penumbra {
namespace {

using test::Voxel;

struct Soup {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;

  void add(const TriangleMesh& mesh, const Vec3& shift = Vec3(0.0)) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3& p : mesh.positions()) positions.push_back(p + shift);
    for (const auto& [a, b, c] : mesh.triangles()) triangles.push_back({a + first, b + first, c + first});
  }
  void add(const std::vector<Vec3>& corners) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), corners.begin(), corners.end());
    for (std::uint32_t k = 2; k < corners.size(); ++k) triangles.push_back({first, first + k - 1, first + k});
  }
  TriangleMesh built() const {
    const TriangleMesh mesh = TriangleMesh::build(positions, triangles);
    test::expect_sound(mesh);
    return mesh;
  }
};

TriangleMesh built(const std::set<Voxel>& voxels) {
  const test::VoxelMesh mesh = test::mesh_of_voxels(voxels);
  return Soup{mesh.positions, mesh.triangles}.built();
}

void expect_solid(const TriangleMesh& mesh, double volume, std::size_t components) {
  const MeshFindings findings = inspect(mesh);
  EXPECT_TRUE(findings.closed);
  EXPECT_DOUBLE_EQ(findings.signed_volume, volume);
  EXPECT_EQ(findings.components, components);
  EXPECT_EQ(findings.build.joined_edges, findings.build.non_manifold_edges);
}

TEST(FacePairs, BarsThatTouchAlongManyEdgesComeApart) {
  std::set<Voxel> bars;
  for (int z = 0; z < 5; ++z) bars.insert({{0, 0, z}, {1, 1, z}});
  const TriangleMesh mesh = built(bars);
  expect_solid(mesh, 10, 2);
  EXPECT_EQ(mesh.report().non_manifold_edges, 5u);
  for (const Component& bar : mesh.components()) EXPECT_DOUBLE_EQ(bar.signed_volume, 5);
}

TEST(FacePairs, ChessboardsStayClosed) {
  std::set<Voxel> voxels;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 6; ++z)
        if ((x + y + z) % 2 == 0) voxels.insert({x, y, z});
  expect_solid(built(voxels), 108, 108);
}

TEST(FacePairs, RingThatTouchesItself) {
  // Both pieces of solid at the edge from (1,1,0) to (1,1,1) are one piece at both of its ends.
  std::set<Voxel> ring = {{0, 0, 0}, {1, 1, 0}};
  for (const int z : {-1, 1}) ring.insert({{0, 0, z}, {0, 1, z}, {1, 1, z}});
  expect_solid(built(ring), 8, 1);
}

TEST(FacePairs, CavitiesCountLess) {
  std::set<Voxel> shell;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) shell.insert({x, y, z});
  for (const Voxel& hole : {Voxel{1, 1, 1}, Voxel{3, 3, 3}}) shell.erase(hole);
  const TriangleMesh mesh = built(shell);
  expect_solid(mesh, 123, 3);
  EXPECT_EQ(mesh.report().flipped_components, 0u);
}

TEST(FacePairs, FinsAlongSeveralEdgesLeaveABoxClosed) {
  Soup soup;
  soup.add(make_box({1, 1, 1}, {1, 1, 1}));
  const std::vector<Vec3> rim = {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = rim[i], &b = rim[(i + 1) % 4], down(0, -1, 0);
    soup.add({a, b, b + down, a + down});
  }
  const MeshFindings findings = inspect(soup.built());
  EXPECT_EQ(findings.closed_components, 1u);
  EXPECT_DOUBLE_EQ(findings.signed_volume, 8);
  EXPECT_EQ(findings.boundary_edges, 8u) << "the skirt's two rims";
}

TEST(FacePairs, WallAcrossABoxIsPutAside) {
  Soup soup;
  soup.add(std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}});
  soup.add(std::vector<Vec3>{{3, 0, 0}, {3, 1, 0}, {3, 1, 1}, {3, 0, 1}});
  for (const auto& [from, to] : {std::pair(0.0, 1.0), std::pair(1.0, 3.0)}) {
    soup.add(std::vector<Vec3>{{from, 0, 0}, {to, 0, 0}, {to, 0, 1}, {from, 0, 1}});
    soup.add(std::vector<Vec3>{{from, 1, 0}, {from, 1, 1}, {to, 1, 1}, {to, 1, 0}});
    soup.add(std::vector<Vec3>{{from, 0, 0}, {from, 1, 0}, {to, 1, 0}, {to, 0, 0}});
    soup.add(std::vector<Vec3>{{from, 0, 1}, {to, 0, 1}, {to, 1, 1}, {from, 1, 1}});
  }
  soup.add(std::vector<Vec3>{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}});
  const MeshFindings findings = inspect(soup.built());
  EXPECT_EQ(findings.components, 2u);
  EXPECT_EQ(findings.closed_components, 1u);
  EXPECT_DOUBLE_EQ(findings.signed_volume, 3);
  EXPECT_EQ(findings.boundary_edges, 4u) << "the wall's";
}

TEST(FacePairs, BoxesThatShareASideStayBoxes) {
  // Turned, so that their common side is not exactly flat.
  const double c = std::cos(0.3), s = std::sin(0.3);
  Soup soup;
  soup.add(make_box({0, 0, 0}, {.5, .5, .5}));
  soup.add(make_box({0, 0, 0}, {.5, .5, .5}), {1, 0, 0});
  for (Vec3& p : soup.positions) p = Vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z + p.x / 3.0);
  const TriangleMesh mesh = soup.built();
  EXPECT_TRUE(mesh.is_closed());
  ASSERT_EQ(mesh.components().size(), 2u);
  EXPECT_NEAR(mesh.components()[0].signed_volume, 1.0, 1e-14);
  EXPECT_NEAR(mesh.components()[1].signed_volume, 1.0, 1e-14);
}

TEST(FacePairs, SheetWithTwoSidesIsClosed) {
  Soup soup;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y) {
      const Vec3 a(x, y, 0), b(x + 1, y, 0), c(x + 1, y + 1, 0.25 * x), d(x, y + 1, 0.25 * x);
      soup.add({a, b, c, d});
      soup.add({d, c, b, a});
    }
  const MeshFindings findings = inspect(soup.built());
  EXPECT_TRUE(findings.closed);
  EXPECT_EQ(findings.boundary_edges, 0u);
}

TEST(FacePairs, VoxelsWithAFaceMissingAreOpenThereAlone) {
  std::set<Voxel> bars;
  for (int z = 0; z < 5; ++z) bars.insert({{0, 0, z}, {1, 1, z}});
  test::VoxelMesh mesh = test::mesh_of_voxels(bars);
  mesh.triangles.erase(mesh.triangles.begin() + 4);
  const MeshFindings findings = inspect(Soup{mesh.positions, mesh.triangles}.built());
  EXPECT_EQ(findings.boundary_edges, 3u);
  EXPECT_EQ(findings.components, 2u);
}

class FacePairsProperty : public testing::TestWithParam<double> {};

TEST_P(FacePairsProperty, RandomVoxelSolidsAreClosedAndHaveTheirVolume) {
  std::mt19937_64 random(200);
  std::size_t joined = 0;
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const std::set<Voxel> voxels = test::random_voxels(random, 3 + round % 4, GetParam());
    if (voxels.empty()) continue;
    test::VoxelMesh mesh = test::mesh_of_voxels(voxels);
    std::ranges::shuffle(mesh.triangles, random);
    const TriangleMesh solid = Soup{mesh.positions, mesh.triangles}.built();
    const MeshFindings findings = inspect(solid);
    EXPECT_TRUE(findings.closed);
    EXPECT_EQ(findings.boundary_edges, 0u);
    EXPECT_EQ(findings.signed_volume, static_cast<double>(voxels.size()));
    joined += findings.build.joined_edges;
    if (HasFailure()) return;
  }
  EXPECT_GT(joined, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Densities, FacePairsProperty, testing::Values(0.15, 0.5, 0.8));

}  // namespace
}  // namespace penumbra
