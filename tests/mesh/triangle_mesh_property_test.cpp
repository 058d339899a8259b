#include <gtest/gtest.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <random>

#include "penumbra/mesh/shapes.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

using test::expect_sound;
using test::face_keys;

struct Soup {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
};

/// Few positions, so that duplicates, fins, bow-ties, misoriented neighbors and degenerate faces abound.
Soup random_soup(std::mt19937_64& random, std::uint32_t vertices, std::uint32_t faces) {
  Soup soup;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    soup.positions.emplace_back(static_cast<double>(random() % 3), static_cast<double>(random() % 3),
                                random() % 2 == 0 ? 0.0 : -0.0);
  }
  for (std::uint32_t i = 0; i < faces; ++i) {
    const auto any = [&] { return static_cast<std::uint32_t>(random() % vertices); };
    const std::uint32_t a = any(), b = any(), c = any();
    soup.triangles.push_back({a, b, c});
  }
  return soup;
}

/// Faces of a closed shape, some turned round, repeated or removed.
Soup damaged_shape(std::mt19937_64& random) {
  const TriangleMesh shape =
      random() % 2 == 0 ? make_icosphere({0, 0, 0}, 1, 1) : make_torus({0, 0, 0}, 1, .4, 6, 5);
  Soup soup{{shape.positions().begin(), shape.positions().end()}, {}};
  for (IndexedTriangle t : shape.triangles()) {
    const auto fate = random() % 16;
    if (fate == 0) {
      continue;
    }
    if (fate == 1) {
      std::swap(t[0], t[1]);
    }
    soup.triangles.push_back(t);
    if (fate == 2) {
      soup.triangles.push_back({t[2], t[1], t[0]});
    }
  }
  return soup;
}

/// Every face is there again at the same place, or reported as degenerate.
void expect_nothing_lost(const Soup& soup, const TriangleMesh& mesh) {
  const BuildReport& report = mesh.report();
  EXPECT_EQ(mesh.triangles().size() + report.degenerate.size(), soup.triangles.size());
  EXPECT_EQ(mesh.positions().size() + report.welded_vertices + report.unused_vertices,
            soup.positions.size() + report.split_vertices);
  std::vector<IndexedTriangle> kept;
  for (const std::uint32_t source : mesh.source_triangles()) {
    kept.push_back(soup.triangles[source]);
  }
  EXPECT_EQ(face_keys(mesh.positions(), mesh.triangles()), face_keys(soup.positions, kept));
}

/// OpenMesh itself accepts the cut mesh face by face and finds the same edges.
void expect_openmesh_agrees(const TriangleMesh& mesh) {
  OpenMesh::TriMesh_ArrayKernelT<> other;
  for (const Vec3& p : mesh.positions()) {
    other.add_vertex(OpenMesh::Vec3f(float(p.x), float(p.y), float(p.z)));
  }
  for (const auto& [a, b, c] : mesh.triangles()) {
    const auto face = other.add_face(OpenMesh::VertexHandle(int(a)), OpenMesh::VertexHandle(int(b)),
                                     OpenMesh::VertexHandle(int(c)));
    ASSERT_TRUE(face.is_valid());
  }
  ASSERT_EQ(other.n_edges(), mesh.edges().size());
  std::size_t boundary = 0;
  for (const auto e : other.edges()) {
    boundary += other.is_boundary(e);
  }
  EXPECT_EQ(boundary, test::boundary_edge_count(mesh));
  for (const auto v : other.vertices()) {
    EXPECT_TRUE(other.is_manifold(v));
  }
}

void expect_same_but_for_numbering(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.positions().size(), b.positions().size());
  EXPECT_EQ(a.edges().size(), b.edges().size());
  EXPECT_EQ(a.components().size(), b.components().size());
  EXPECT_EQ(test::boundary_edge_count(a), test::boundary_edge_count(b));
  EXPECT_EQ(face_keys(a.positions(), a.triangles()), face_keys(b.positions(), b.triangles()));
}

class TriangleMeshProperty : public testing::TestWithParam<std::uint64_t> {};

TEST_P(TriangleMeshProperty, HoldsForEverySoup) {
  std::mt19937_64 random(GetParam());
  for (int round = 0; round < 100; ++round) {
    SCOPED_TRACE("seed " + std::to_string(GetParam()) + ", round " + std::to_string(round));
    const auto vertices = static_cast<std::uint32_t>(3 + random() % 12);
    Soup soup = round % 2 == 0 ? random_soup(random, vertices, static_cast<std::uint32_t>(1 + random() % 40))
                               : damaged_shape(random);
    const BuildOptions options{.weld = round % 5 != 0, .flip_inside_out = round % 3 != 0};
    const TriangleMesh mesh = TriangleMesh::build(soup.positions, soup.triangles, options);
    expect_sound(mesh);
    expect_nothing_lost(soup, mesh);
    expect_openmesh_agrees(mesh);
    std::shuffle(soup.triangles.begin(), soup.triangles.end(), random);
    expect_same_but_for_numbering(mesh, TriangleMesh::build(soup.positions, soup.triangles, options));
    if (HasFailure()) {
      return;
    }
  }
}

TEST_P(TriangleMeshProperty, BuildingTwiceGivesTheSame) {
  std::mt19937_64 random(GetParam());
  const Soup soup = damaged_shape(random);
  const TriangleMesh a = TriangleMesh::build(soup.positions, soup.triangles);
  const TriangleMesh b = TriangleMesh::build(soup.positions, soup.triangles);
  EXPECT_TRUE(std::ranges::equal(a.triangles(), b.triangles()));
  EXPECT_TRUE(std::ranges::equal(a.face_edges(), b.face_edges()));
  EXPECT_TRUE(std::ranges::equal(a.positions(), b.positions()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, TriangleMeshProperty, testing::Range<std::uint64_t>(1, 11));

}  // namespace
}  // namespace penumbra
