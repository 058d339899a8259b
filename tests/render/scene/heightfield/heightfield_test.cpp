// Heightfields in scenes: where posts, triangles, tiles and normals are, gaps, transforms, complaints.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>

#include "tests/render/scene/heightfield/height_support.h"

namespace penumbra {
namespace {

using Heightfield = testing::HeightFiles;
constexpr float kGap = std::numeric_limits<float>::quiet_NaN();

/// Corners of a face, the least first.
std::array<Vec3, 3> face(const TriangleMesh& mesh, std::size_t f) {
  const auto& [a, b, c] = mesh.triangles()[f];
  return {mesh.positions()[a], mesh.positions()[b], mesh.positions()[c]};
}
Vec3 upward(const TriangleMesh& mesh, std::size_t f) {
  const auto [a, b, c] = face(mesh, f);
  return glm::cross(b - a, c - a);
}
std::size_t triangles_of(const Scene& scene) {
  std::size_t count = 0;
  for (const SceneObject& object : scene.objects) count += object.mesh.triangles().size();
  return count;
}

TEST_F(Heightfield, APostStandsEastAndSouthAndUp) {
  write_npy("h.npy", {{0, 1}, {2, 4}});
  const Scene scene = scene_of(R"("heightfield": "h.npy")");
  ASSERT_EQ(scene.objects.size(), 1u);
  const TriangleMesh& mesh = scene.objects[0].mesh;
  ASSERT_EQ(mesh.triangles().size(), 2u);
  EXPECT_EQ(face(mesh, 0), (std::array<Vec3, 3>{Vec3(0, 0, 0), Vec3(0, 2, 1), Vec3(1, 1, 0)}));
  EXPECT_EQ(face(mesh, 1), (std::array<Vec3, 3>{Vec3(1, 1, 0), Vec3(0, 2, 1), Vec3(1, 4, 1)}));
  EXPECT_EQ(scene.objects[0].name, "h.npy[0,0]");
  EXPECT_EQ(scene.files, std::vector<std::filesystem::path>{path("h.npy")});
}

TEST_F(Heightfield, TransformsAndMirrorsKeepFacesUp) {
  write_npy("h.npy", {{0, 1, 0}, {2, 4, 3}});
  const Scene scene = scene_of(
      R"("heightfield": "h.npy", "translation": [5, 6, 7], "scale": [-10, 3, 20], "albedo": 0.25, "casts": false)");
  const SceneObject& object = scene.objects[0];
  EXPECT_EQ(object.mesh.positions()[4], Vec3(-5, 18, 27));
  EXPECT_EQ(object.albedo, Vec3(0.25));
  EXPECT_FALSE(object.casts);
  for (std::size_t f = 0; f < 4; ++f) EXPECT_GT(upward(object.mesh, f).y, 0.0) << f;
}

TEST_F(Heightfield, TrianglesAtGapsAreLeftOut) {
  write_npy("h.npy", {{0, 0, 0}, {0, kGap, 0}, {0, 0, std::numeric_limits<float>::infinity()}});
  const Scene scene = scene_of(R"("heightfield": "h.npy")");
  EXPECT_EQ(triangles_of(scene),
            1u);  // at the corner that a diagonal cuts off from the middle; the other such corner is a gap
  EXPECT_NE(complaint_of(R"("heightfield": "none.npy")").find("no such file"), std::string::npos);
  write_npy("gaps.npy", {{0, kGap, 0}, {kGap, kGap, kGap}});
  EXPECT_NE(complaint_of(R"("heightfield": "gaps.npy")").find("no three posts"), std::string::npos);
  write_npy("none.npy", {{kGap, kGap}, {kGap, kGap}});
  EXPECT_NE(complaint_of(R"("heightfield": "none.npy")").find("only gaps"), std::string::npos);
  write_npy("row.npy", {{0, 1, 2}});
  EXPECT_NE(complaint_of(R"("heightfield": "row.npy")").find("at least 2 x 2"), std::string::npos);
}

std::vector<std::vector<float>> bumps(std::size_t rows, std::size_t columns) {
  std::vector<std::vector<float>> heights(rows, std::vector<float>(columns));
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      heights[r][c] = static_cast<float>(std::sin(0.7 * static_cast<double>(r * r)) +
                                         std::cos(1.3 * static_cast<double>(c)));
  return heights;
}

TEST_F(Heightfield, TilesHaveAllTrianglesOnceAndShareTheirBorders) {
  write_npy("h.npy", bumps(11, 18));
  const Scene whole = scene_of(R"("heightfield": "h.npy")"),
              tiled = scene_of(R"("heightfield": "h.npy", "tile": 4)");
  ASSERT_EQ(whole.objects.size(), 1u);
  ASSERT_EQ(tiled.objects.size(), 3u * 5u);
  EXPECT_EQ(tiled.objects.back().name, "h.npy[2,4]");
  using Corners = std::array<double, 9>;
  const auto all = [](const Scene& scene) {
    std::multiset<Corners> out;
    for (const SceneObject& object : scene.objects)
      for (std::size_t f = 0; f < object.mesh.triangles().size(); ++f) {
        const auto [a, b, c] = face(object.mesh, f);
        out.insert({a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z});
      }
    return out;
  };
  EXPECT_EQ(all(tiled).size(), 2u * 10u * 17u);
  EXPECT_EQ(all(tiled), all(whole));
}

TEST_F(Heightfield, TilesFadeAsOne) {
  write_npy("h.npy", bumps(9, 9));
  const Scene whole = scene_of(R"("heightfield": "h.npy", "fade": [1, 3])"),
              tiled = scene_of(R"("heightfield": "h.npy", "fade": [1, 3], "tile": 4)");
  ASSERT_GT(tiled.objects.size(), 1u);
  for (const SceneObject& tile : tiled.objects)
    EXPECT_EQ(tile.fade.middle, whole.objects[0].mesh.bounds().center());
}

TEST_F(Heightfield, SmoothNormalsDoNotSeeTiles) {
  write_npy("h.npy", bumps(9, 9));
  const auto normals = [this](const std::string& tile) {
    std::set<std::array<double, 6>> out;
    for (const SceneObject& object :
         scene_of(R"("heightfield": "h.npy", "smooth": true, "tile": )" + tile).objects)
      for (std::size_t f = 0; f < object.mesh.triangles().size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3 p = face(object.mesh, f)[k], n(object.corner_normals[f][k]);
          EXPECT_NEAR(glm::length(n), 1.0, 1e-6);
          EXPECT_GT(n.y, 0.0);
          out.insert({p.x, p.y, p.z, n.x, n.y, n.z});
        }
    return out;
  };
  const auto once = normals("64");
  EXPECT_EQ(once.size(), 81u);  // one a post
  EXPECT_EQ(normals("2"), once);
  EXPECT_TRUE(scene_of(R"("heightfield": "h.npy")").objects[0].corner_normals.empty());
}

TEST_F(Heightfield, ComplaintsNameTheKey) {
  write_npy("h.npy", {{0, 1}, {2, 4}});
  EXPECT_NE(complaint_of(R"("heightfield": "h.npy", "tile": 0)").find("/objects/0/tile"), std::string::npos);
  EXPECT_NE(complaint_of(R"("heightfield": "h.npy", "tile": 1.5)").find("whole number"), std::string::npos);
  EXPECT_NE(complaint_of(R"("heightfield": "")").find("/objects/0/heightfield"), std::string::npos);
  EXPECT_NE(complaint_of(R"("heightfield": 3)").find("must be a string"), std::string::npos);
  write_text("cut.npy", "\x93NUMPY");
  EXPECT_NE(complaint_of(R"("heightfield": "cut.npy")").find("cut.npy"), std::string::npos);
  write_npy("far.npy", {{0, 1e38f}, {0, 0}});
  EXPECT_NE(complaint_of(R"("heightfield": "far.npy", "scale": [1, 1e70, 1])").find("lies beyond"),
            std::string::npos);
  std::vector<std::string> warnings;
  scene_of(R"("heightfield": "h.npy", "mesh": "cube.off")", &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("/objects/0/mesh"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace penumbra
