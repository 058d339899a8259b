// Faces that are taken for one: what that costs, by looking at every face.
#include "render/silhouette/merge/face_patches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/render/render_support.h"
#include "tests/render/silhouette/fine_meshes.h"

namespace penumbra::detail {
namespace {

using penumbra::testing::fine_meshes;
using penumbra::testing::Random;

struct Face {
  double area;
  Vec3 normal, corner;
};

std::vector<Face> faces_of(const TriangleMesh& mesh, const FacePatches::Partition& partition,
                           std::uint32_t patch) {
  std::vector<Face> out;
  for (std::size_t i = 0; i < partition.side.size(); ++i) {
    if (partition.side[i] != patch + partition.side.size()) continue;
    const auto& [a, b, c] = mesh.triangles()[i];
    const Vec3 p = mesh.positions()[a], n = glm::cross(mesh.positions()[b] - p, mesh.positions()[c] - p);
    out.push_back({0.5 * glm::length(n), glm::normalize(n), p});
  }
  return out;
}

/// What is taken for the wrong side, seen from x, is no more than the error says.
void expect_error_holds(const std::vector<Face>& faces, const FacePatch& patch, const Vec3& x) {
  double area = 0.0, sum = 0.0, magnitudes = 0.0;
  for (const Face& f : faces) {
    const double v = f.area * glm::dot(f.normal, x - f.corner);
    area += f.area, sum += v, magnitudes += std::abs(v);
    const double mean = glm::dot(patch.normal, x - patch.center);
    ASSERT_LE(std::abs(v / f.area - mean),
              patch.tilt * glm::distance(x, patch.center) + patch.spread + 1e-12);
  }
  const double mistaken = 0.5 * (magnitudes - std::abs(sum));
  ASSERT_LE(mistaken, patch.mistaken(x) * (1.0 + 1e-9) + 1e-12);
  const double away = std::max(patch.radius, glm::distance(x, patch.center));
  ASSERT_LE(mistaken, patch.error * std::sqrt(area) * away * (1.0 + 1e-9) + 1e-12);
}

TEST(FacePatches, ErrorsHoldFromEverywhere) {
  Random random(71);
  std::size_t patches = 0;
  for (const auto& [name, mesh] : fine_meshes(5)) {
    const FacePatches all(mesh);
    const double size = bounds_of(mesh.positions()).radius();
    for (const double tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) {
      const FacePatches::Partition partition = all.partition(tolerance * size);
      for (std::uint32_t i = 0; i < partition.patches.size();
           i += 1 + static_cast<std::uint32_t>(partition.patches.size()) / 40) {
        const FacePatch& patch = partition.patches[i];
        ASSERT_LE(patch.error, tolerance * size);
        const std::vector<Face> faces = faces_of(mesh, partition, i);
        ASSERT_GE(faces.size(), 2u) << name;
        ++patches;
        for (int k = 0; k < 20; ++k) {
          // Also from where the patch is seen edge-on.
          Vec3 away = random.direction();
          if (k % 2 == 0) away = glm::normalize(away - glm::dot(away, patch.normal) * patch.normal);
          expect_error_holds(faces, patch, patch.center + random.spread(0.1, 100.0) * patch.radius * away);
        }
      }
    }
  }
  EXPECT_GT(patches, 300u);
}

TEST(FacePatches, HoldTheirFaces) {
  for (const auto& [name, mesh] : fine_meshes(5)) {
    const FacePatches::Partition partition =
        FacePatches(mesh).partition(1e-3 * bounds_of(mesh.positions()).radius());
    for (std::size_t i = 0; i < partition.side.size(); ++i) {
      if (partition.side[i] < partition.side.size()) {
        ASSERT_EQ(partition.side[i], i);
        continue;
      }
      const FacePatch& patch = partition.patches[partition.side[i] - partition.side.size()];
      for (const std::uint32_t v : mesh.triangles()[i]) {
        ASSERT_LE(glm::distance(mesh.positions()[v], patch.center), patch.radius * (1.0 + 1e-12)) << name;
        ASSERT_LE(std::abs(glm::dot(patch.normal, mesh.positions()[v] - patch.center)), patch.thick + 1e-15);
      }
    }
  }
}

TEST(FacePatches, AFlatSideIsOne) {
  for (const char* name : {"box", "box in float"}) {
    const TriangleMesh mesh = fine_meshes(5)[name];
    const FacePatches::Partition partition = FacePatches(mesh).partition(1e-6);
    EXPECT_EQ(partition.patches.size(), 6u) << name;
    for (const FacePatch& p : partition.patches) EXPECT_TRUE(p.is_flat());
  }
}

/// Small closed pieces must not vanish within a patch.
TEST(FacePatches, NoClosedSurfaceIsWithinOne) {
  Random random(72);
  std::vector<Vec3> points;
  std::vector<IndexedTriangle> faces;
  for (std::uint32_t i = 0; i < 500; ++i) {
    const Vec3 p = random.point();
    for (int k = 0; k < 4; ++k) points.push_back(p + 1e-4 * random.point());
    for (const IndexedTriangle& t : {IndexedTriangle{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})
      faces.push_back({4 * i + t[0], 4 * i + t[1], 4 * i + t[2]});
  }
  const TriangleMesh dust = TriangleMesh::build(points, faces);
  const FacePatches::Partition partition = FacePatches(dust).partition(10.0);
  for (const Component& c : dust.components()) {
    std::set<std::uint32_t> sides;
    for (const FaceId f : c.faces) sides.insert(partition.side[index(f)]);
    EXPECT_GE(sides.size(), 2u);
  }
}

}  // namespace
}  // namespace penumbra::detail
