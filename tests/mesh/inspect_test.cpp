#include "penumbra/mesh/inspect.h"

#include <gtest/gtest.h>

#include "penumbra/mesh/shapes.h"
#include "tests/mesh/mesh_samples.h"

namespace penumbra {
namespace {

TriangleMesh box_beside_a_repeated_triangle() {
  const TriangleMesh box = make_box({0, 0, 0}, {1, 1, 1});
  std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
  std::vector<IndexedTriangle> triangles(box.triangles().begin(), box.triangles().end());
  positions.insert(positions.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  triangles.insert(triangles.end(), {{8, 9, 10}, {8, 9, 10}, {8, 8, 9}});
  return TriangleMesh::build(positions, triangles);
}

TEST(Inspect, CountsAndMeasures) {
  const MeshFindings findings = inspect(box_beside_a_repeated_triangle());
  EXPECT_EQ(findings.vertices, 14u);
  EXPECT_EQ(findings.faces, 14u);
  EXPECT_EQ(findings.edges, 24u);
  EXPECT_EQ(findings.components, 3u);
  EXPECT_EQ(findings.closed_components, 1u);
  EXPECT_EQ(findings.boundary_edges, 6u);
  EXPECT_EQ(findings.boundary_vertices, 6u);
  EXPECT_FALSE(findings.closed);
  EXPECT_DOUBLE_EQ(findings.signed_volume, 8.0);
  EXPECT_DOUBLE_EQ(findings.surface_area, 25.0);
  EXPECT_EQ(findings.bounds.high, Vec3(6, 1, 1));
}

TEST(Inspect, TextTellsWhatWasFound) {
  const std::string text = to_text(inspect(box_beside_a_repeated_triangle()));
  EXPECT_NE(text.find("6 boundary edges"), std::string::npos) << text;
  EXPECT_NE(text.find("1 faces that repeat another kept (input triangles 13)"), std::string::npos) << text;
  EXPECT_NE(text.find("1 degenerate faces left out (input triangles 14)"), std::string::npos) << text;
  EXPECT_NE(to_text(inspect(make_box({0, 0, 0}, {1, 1, 1}))).find("none"), std::string::npos);
}

TEST(Inspect, BoundsFarFromTheOriginHaveEnoughDigits) {
  const auto bounds_line = [](const Vec3& center, double half) {
    const std::string text = to_text(inspect(make_box(center, Vec3(half))));
    const std::size_t begin = text.find("bounds");
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(bounds_line({0, 0, 0}, 1), "bounds        (-1, -1, -1) to (1, 1, 1)");
  EXPECT_EQ(bounds_line({0.1, 0.2, 0.3}, 1.0 / 3),
            "bounds        (-0.233333, -0.133333, -0.0333333) to (0.433333, 0.533333, 0.633333)");
  EXPECT_EQ(bounds_line({465000.125, 5247000.5, 612.25}, 50),
            "bounds        (464950.125, 5246950.5, 562.25) to (465050.125, 5247050.5, 662.25)");
  EXPECT_EQ(bounds_line({1e9, 0, 0}, 0.125),
            "bounds        (999999999.875, -0.125, -0.125) to (1000000000.125, 0.125, 0.125)");
}

TEST(Inspect, TellsOfPolygonsAndOfWhatIsIgnored) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "a.obj", "v 0 0 0\nv 2 0 1\nv 0 0 2\nv .5 0 1\nvt 0 1\nvn 0 1 0\nf 1//1 2 3 4\n");
  const std::string text = to_text(inspect(load_mesh(folder / "a.obj")));
  EXPECT_NE(text.find("normals       of corners, for smooth shading\n"), std::string::npos) << text;
  EXPECT_NE(text.find("polygons      1 divided into triangles, 1 of them not convex\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("ignored       texture coordinates\n"), std::string::npos) << text;
}

TEST(Inspect, EmptyMeshHasNoBounds) {
  const MeshFindings findings = inspect(TriangleMesh());
  EXPECT_TRUE(findings.bounds.empty());
  EXPECT_NE(to_text(findings).find("empty"), std::string::npos);
}

}  // namespace
}  // namespace penumbra
