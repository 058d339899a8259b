#include "penumbra/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using test::boundary_edge_count;
using test::euler_characteristic;
using test::expect_sound;

using Triangles = std::vector<IndexedTriangle>;

const std::vector<Vec3> kCubeCorners = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1},
                                        {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}};
const Triangles kCube = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                         {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};

Triangles reversed(Triangles triangles) {
  for (IndexedTriangle& t : triangles) {
    std::swap(t[1], t[2]);
  }
  return triangles;
}

Triangles joined(Triangles a, const Triangles& b, std::uint32_t offset) {
  for (const auto& [i, j, k] : b) {
    a.push_back({i + offset, j + offset, k + offset});
  }
  return a;
}

TEST(TriangleMesh, KnowsItsBoundsAndItsLongestEdge) {
  const TriangleMesh cube = TriangleMesh::build(kCubeCorners, kCube);
  EXPECT_EQ(cube.bounds().low, Vec3(0.0));
  EXPECT_EQ(cube.bounds().high, Vec3(1.0));
  EXPECT_DOUBLE_EQ(cube.longest_edge(), std::sqrt(2.0));
  EXPECT_TRUE(TriangleMesh().bounds().empty());
  EXPECT_EQ(TriangleMesh().longest_edge(), 0.0);
}

TEST(TriangleMesh, EmptyInputIsAnEmptyMesh) {
  const TriangleMesh mesh = TriangleMesh::build({}, {});
  EXPECT_TRUE(mesh.empty());
  EXPECT_FALSE(mesh.is_closed());
  EXPECT_TRUE(TriangleMesh().empty());
  EXPECT_TRUE(TriangleMesh().edges().empty());
}

TEST(TriangleMesh, OneTriangleHasThreeBoundaryEdges) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const TriangleMesh mesh = TriangleMesh::build(positions, Triangles{{0, 1, 2}});
  expect_sound(mesh);
  ASSERT_EQ(mesh.edges().size(), 3u);
  const Edge& e = mesh.edges()[0];
  EXPECT_EQ(e.from, VertexId{0});
  EXPECT_EQ(e.to, VertexId{1});
  EXPECT_EQ(e.left, FaceId{0});
  EXPECT_EQ(e.left_apex, VertexId{2});
  EXPECT_TRUE(e.is_boundary());
  EXPECT_EQ(e.right_apex, kNone<VertexId>);
  EXPECT_FALSE(mesh.is_closed());
}

TEST(TriangleMesh, CubeIsClosedAndOutward) {
  const TriangleMesh mesh = TriangleMesh::build(kCubeCorners, kCube);
  expect_sound(mesh);
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_EQ(mesh.edges().size(), 18u);
  EXPECT_EQ(euler_characteristic(mesh), 2);
  ASSERT_EQ(mesh.components().size(), 1u);
  EXPECT_DOUBLE_EQ(mesh.components()[0].signed_volume, 1.0);
  EXPECT_EQ(mesh.report().flipped_components, 0u);
}

TEST(TriangleMesh, InsideOutCubeIsTurnedOutward) {
  const TriangleMesh mesh = TriangleMesh::build(kCubeCorners, reversed(kCube));
  expect_sound(mesh);
  EXPECT_DOUBLE_EQ(mesh.components()[0].signed_volume, 1.0);
  EXPECT_EQ(mesh.report().flipped_components, 1u);
  EXPECT_EQ(mesh.report().flipped_faces, 12u);

  const TriangleMesh kept = TriangleMesh::build(kCubeCorners, reversed(kCube), {.flip_inside_out = false});
  expect_sound(kept);
  EXPECT_DOUBLE_EQ(kept.components()[0].signed_volume, -1.0);
  EXPECT_EQ(kept.report().flipped_components, 0u);
}

TEST(TriangleMesh, VolumeIsAccurateFarFromTheOrigin) {
  std::vector<Vec3> far = kCubeCorners;
  for (Vec3& p : far) {
    p += Vec3(1e9, -2e9, 3e9);
  }
  EXPECT_DOUBLE_EQ(TriangleMesh::build(far, kCube).components()[0].signed_volume, 1.0);
}

TEST(TriangleMesh, WeldsExactlyEqualPositionsAndSignedZeros) {
  std::vector<Vec3> positions;
  Triangles triangles;
  for (const IndexedTriangle& t : kCube) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const std::uint32_t v : t) {
      const double zero = first % 2 == 0 ? 0.0 : -0.0;
      Vec3 p = kCubeCorners[v];
      p = {p.x == 0 ? zero : p.x, p.y == 0 ? zero : p.y, p.z == 0 ? zero : p.z};
      positions.push_back(p);
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  positions.emplace_back(5, 5, 5);  // used by none
  const TriangleMesh mesh = TriangleMesh::build(positions, triangles);
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_EQ(mesh.positions().size(), 8u);
  EXPECT_EQ(mesh.report().welded_vertices, 28u);
  EXPECT_EQ(mesh.report().unused_vertices, 1u);

  const TriangleMesh apart = TriangleMesh::build(positions, triangles, {.weld = false});
  expect_sound(apart);
  EXPECT_EQ(apart.positions().size(), 36u);
  EXPECT_EQ(apart.components().size(), 12u);
  EXPECT_EQ(apart.report().welded_vertices, 0u);
}

TEST(TriangleMesh, PositionsOneUlpApartStayApart) {
  const double next = std::nextafter(1.0, 2.0);
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {next, 0, 0}, {0, 0, 1}};
  const TriangleMesh mesh = TriangleMesh::build(positions, Triangles{{0, 1, 2}, {3, 0, 4}});
  EXPECT_EQ(mesh.positions().size(), 6u);  // the shared origin is split: two fans
  EXPECT_EQ(mesh.report().non_manifold_vertices, 1u);
}

TEST(TriangleMesh, ThreeFacesAtAnEdgeAreCutApart) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 1}, {-1, 0, -1}};
  const TriangleMesh mesh = TriangleMesh::build(positions, Triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  expect_sound(mesh);
  EXPECT_EQ(mesh.triangles().size(), 3u);
  EXPECT_EQ(mesh.report().non_manifold_edges, 1u);
  EXPECT_EQ(mesh.report().non_manifold_vertices, 2u);
  EXPECT_EQ(mesh.report().split_vertices, 4u);
  EXPECT_EQ(mesh.components().size(), 3u);
  EXPECT_EQ(boundary_edge_count(mesh), 9u);
}

TEST(TriangleMesh, BowTieVertexIsSplit) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const TriangleMesh mesh = TriangleMesh::build(positions, Triangles{{0, 2, 1}, {0, 3, 4}});
  expect_sound(mesh);
  EXPECT_EQ(mesh.positions().size(), 6u);
  EXPECT_EQ(mesh.report().non_manifold_vertices, 1u);
  EXPECT_EQ(mesh.report().split_vertices, 1u);
  EXPECT_EQ(mesh.positions()[0], mesh.positions()[5]);
}

TEST(TriangleMesh, CubesThatTouchAtACornerOrAnEdgeStayClosed) {
  for (const Vec3& shift : {Vec3(1, 1, 1), Vec3(1, 1, 0)}) {
    std::vector<Vec3> positions = kCubeCorners;
    for (const Vec3& p : kCubeCorners) {
      positions.push_back(p + shift);
    }
    const TriangleMesh mesh = TriangleMesh::build(positions, joined(kCube, kCube, 8));
    expect_sound(mesh);
    EXPECT_TRUE(mesh.is_closed());
    EXPECT_EQ(mesh.components().size(), 2u);
    EXPECT_EQ(mesh.positions().size(), 16u);
    EXPECT_EQ(mesh.report().non_manifold_edges, shift.z == 0 ? 1u : 0u);
  }
}

TEST(TriangleMesh, CubeWithAFinStaysClosed) {
  std::vector<Vec3> positions = kCubeCorners;
  positions.emplace_back(-1, -1, 0);
  const TriangleMesh mesh = TriangleMesh::build(positions, joined({{0, 1, 8}}, kCube, 0));
  expect_sound(mesh);
  ASSERT_EQ(mesh.components().size(), 2u);
  EXPECT_FALSE(mesh.components()[0].closed);
  EXPECT_TRUE(mesh.components()[1].closed);
  EXPECT_EQ(mesh.report().non_manifold_edges, 1u);
  EXPECT_EQ(boundary_edge_count(mesh), 3u);
}

TEST(TriangleMesh, MoebiusStripIsCutAtOneEdge) {
  constexpr std::uint32_t kQuads = 8;
  std::vector<Vec3> positions;
  Triangles triangles;
  for (std::uint32_t i = 0; i < kQuads; ++i) {
    const double turn = 2 * 3.14159265358979 * i / kQuads;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(turn / 2);
      positions.emplace_back(r * std::cos(turn), side * std::sin(turn / 2), r * std::sin(turn));
    }
    const bool last = i + 1 == kQuads;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    triangles.push_back({a, b, c});
    triangles.push_back({b, d, c});
  }
  const TriangleMesh mesh = TriangleMesh::build(positions, triangles);
  expect_sound(mesh);
  EXPECT_EQ(mesh.report().misoriented_edges, 1u);
  EXPECT_EQ(mesh.report().split_vertices, 2u);
  EXPECT_EQ(mesh.components().size(), 1u);
  EXPECT_EQ(euler_characteristic(mesh), 1) << "an untwisted strip";
}

TEST(TriangleMesh, MisorientedFaceKeepsItsLikeMindedNeighbors) {
  // A strip of four triangles, the last two turned round: only the edge between the pairs is cut.
  const std::vector<Vec3> positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  const TriangleMesh mesh =
      TriangleMesh::build(positions, Triangles{{0, 2, 1}, {2, 3, 1}, {2, 3, 4}, {3, 5, 4}});
  expect_sound(mesh);
  EXPECT_EQ(mesh.report().misoriented_edges, 1u);
  EXPECT_EQ(mesh.components().size(), 2u);
  EXPECT_EQ(boundary_edge_count(mesh), 8u);
}

TEST(TriangleMesh, OneTurnedFaceOfACubeComesLoose) {
  Triangles triangles = kCube;
  std::swap(triangles[7][0], triangles[7][1]);
  const TriangleMesh mesh = TriangleMesh::build(kCubeCorners, triangles);
  expect_sound(mesh);
  EXPECT_EQ(mesh.report().misoriented_edges, 3u);
  EXPECT_EQ(mesh.components().size(), 2u);
  EXPECT_EQ(mesh.components()[0].faces.size(), 11u);
  EXPECT_EQ(boundary_edge_count(mesh), 6u);
}

TEST(TriangleMesh, DuplicateFacesAreKeptAndReported) {
  const TriangleMesh same = TriangleMesh::build(kCubeCorners, joined(kCube, {{3, 0, 1}}, 0));
  expect_sound(same);
  EXPECT_EQ(same.triangles().size(), 13u);
  EXPECT_EQ(same.report().duplicates, (std::vector<std::uint32_t>{12}));
  EXPECT_EQ(same.report().non_manifold_edges, 3u);
  EXPECT_EQ(same.components().size(), 2u) << "the cube stays closed";

  const TriangleMesh opposite = TriangleMesh::build(kCubeCorners, joined(kCube, {{1, 0, 3}}, 0));
  expect_sound(opposite);
  EXPECT_EQ(opposite.report().duplicates, (std::vector<std::uint32_t>{12}));
}

TEST(TriangleMesh, TwoOppositeFacesMakeAClosedPillow) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const TriangleMesh mesh = TriangleMesh::build(positions, Triangles{{0, 1, 2}, {0, 2, 1}});
  expect_sound(mesh);
  EXPECT_TRUE(mesh.is_closed());
  EXPECT_EQ(mesh.edges().size(), 3u);
  EXPECT_EQ(mesh.components()[0].signed_volume, 0.0);
}

TEST(TriangleMesh, DegenerateFacesAreLeftOutAndZeroAreaOnesKept) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}};
  const TriangleMesh mesh =
      TriangleMesh::build(positions, Triangles{{0, 0, 3}, {0, 1, 2}, {4, 1, 0}, {0, 1, 3}, {3, 3, 3}});
  expect_sound(mesh);
  EXPECT_EQ(mesh.report().degenerate, (std::vector<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(mesh.report().zero_area, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(mesh.source_triangles()[0], 1u);
  EXPECT_EQ(mesh.source_triangles()[1], 3u);
  EXPECT_EQ(mesh.triangles().size(), 2u);
}

TEST(TriangleMesh, TinyAndHugeTrianglesAreNotCalledZeroArea) {
  for (const double size : {1e-200, 1e-300, 1e200}) {
    const std::vector<Vec3> positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {2 * size, 0, 0}};
    const TriangleMesh mesh = TriangleMesh::build(positions, Triangles{{0, 1, 2}, {0, 1, 3}});
    EXPECT_EQ(mesh.triangles().size(), 2u);
    EXPECT_EQ(std::ranges::count(mesh.report().zero_area, 0u), 0) << size;
  }
}

TEST(TriangleMesh, RefusesBadIndicesAndCoordinates) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_NE(test::mesh_error_of([&] {
              TriangleMesh::build(positions, Triangles{{0, 1, 3}});
            }).find("vertex 3"),
            std::string::npos);
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<Vec3> broken = positions;
    broken[1].y = bad;
    const std::string message = test::mesh_error_of([&] {
      TriangleMesh::build(broken, Triangles{{0, 1, 2}});
    });
    EXPECT_NE(message.find("vertex 1"), std::string::npos) << message;
  }
}

TEST(TriangleMesh, LargeFanTakesLinearTime) {
  constexpr std::uint32_t kFaces = 400000;  // quadratic would be minutes
  std::vector<Vec3> positions = {{0, 0, 0}};
  Triangles triangles;
  for (std::uint32_t i = 0; i <= kFaces; ++i) {
    positions.emplace_back(1.0, i, 0.0);
    if (i > 0) {
      triangles.push_back({0, i, i + 1});
    }
  }
  const TriangleMesh mesh = TriangleMesh::build(positions, triangles);
  EXPECT_EQ(mesh.components().size(), 1u);
  EXPECT_EQ(boundary_edge_count(mesh), kFaces + 2);
}

TEST(TriangleMesh, ManyFacesAtOneEdgeAreAllKept) {
  constexpr std::uint32_t kFaces = 20000;
  std::vector<Vec3> positions = {{0, 0, 0}, {0, 1, 0}};
  Triangles triangles;
  for (std::uint32_t i = 0; i < kFaces; ++i) {
    positions.emplace_back(1.0, 0.0, i);
    triangles.push_back(i % 2 == 0 ? IndexedTriangle{0, 1, i + 2} : IndexedTriangle{1, 0, i + 2});
  }
  const TriangleMesh mesh = TriangleMesh::build(positions, triangles);
  EXPECT_EQ(mesh.triangles().size(), kFaces);
  EXPECT_EQ(mesh.components().size(), kFaces / 2) << "as many run one way as the other";
  EXPECT_EQ(mesh.report().non_manifold_edges, 1u);
  EXPECT_EQ(mesh.report().joined_edges, 1u);
}

TEST(Bounds, CenterAndRadius) {
  Bounds bounds;
  EXPECT_TRUE(bounds.empty());
  EXPECT_EQ(bounds.radius(), 0.0);
  bounds.add(Vec3(1, 2, 3));
  EXPECT_FALSE(bounds.empty());
  EXPECT_EQ(bounds.radius(), 0.0);
  bounds.add(bounds_of(std::vector<Vec3>{{3, 4, 4}, {2, 2, 2}}));
  EXPECT_EQ(bounds.low, Vec3(1, 2, 2));
  EXPECT_EQ(bounds.high, Vec3(3, 4, 4));
  EXPECT_EQ(bounds.center(), Vec3(2, 3, 3));
  EXPECT_DOUBLE_EQ(bounds.radius(), std::sqrt(3.0));
  bounds.add(Bounds());
  EXPECT_EQ(bounds.high, Vec3(3, 4, 4));
}

}  // namespace
}  // namespace penumbra
