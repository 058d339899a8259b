#include "penumbra/volumes/classify.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <iostream>
#include <numbers>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/silhouettes.h"
#include "tests/volumes/random_inputs.h"
#include "tests/volumes/scene_caster.h"

namespace penumbra {
namespace {

TEST(ClassifyFaces, CubeUnderASmallLight) {
  const TriangleMesh cube = make_box(Vec3(0.0), Vec3(1.0));
  const Classification c = classify_faces(cube, {{0, 5, 0}, {0, -1, 0}, 0.5});
  EXPECT_EQ(c.all_front, 2u);  // the top
  EXPECT_EQ(c.none_front, 10u);
  EXPECT_EQ(c.mixed, 0u);
  EXPECT_EQ(c.tally.filter + c.tally.interval + c.tally.exact, 12u);
  const Classification wide = classify_faces(cube, {{0, 5, 0}, {0, -1, 0}, 2.0});
  EXPECT_EQ(wide.mixed, 8u);  // the sides
}

TEST(ClassifyFaces, EmptyMesh) {
  EXPECT_TRUE(classify_faces(TriangleMesh(), DiskLight{}).faces.empty());
}

TEST(ClassifyFaces, AgreesWithBruteForceOverTheDisk) {
  constexpr std::uint64_t kSeed = 11;
  testing::RandomInputs random(kSeed);
  for (int round = 0; round < 20; ++round) {
    const TriangleMesh mesh = make_random_triangles(Vec3(0.0), 2.0, 0.5, 200, kSeed + round);
    const DiskLight light{random.uniform_point(3.0), random.direction() * 2.0, random.uniform(0, 1.5)};
    const LightFrame frame = light_frame(light);
    const Classification classes = classify_faces(mesh, light);
    for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
      const IndexedTriangle& t = mesh.triangles()[f];
      const Vec3 a = mesh.positions()[t[0]];
      const Vec3 n = glm::normalize(glm::cross(mesh.positions()[t[1]] - a, mesh.positions()[t[2]] - a));
      double least = 1e300, most = -1e300;
      for (int j = 0; j < 360; ++j) {
        const double angle = 2 * std::numbers::pi * j / 360;
        const Vec3 p = light.center + light.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v);
        least = std::min(least, glm::dot(n, p - a));
        most = std::max(most, glm::dot(n, p - a));
      }
      if (std::abs(least) < 1e-3 || std::abs(most) < 1e-3) continue;  // sampling cannot tell
      const FaceClass expected =
          least > 0 ? FaceClass::kAllFront : (most < 0 ? FaceClass::kNoneFront : FaceClass::kMixed);
      ASSERT_EQ(classes.faces[f], expected) << "seed " << kSeed << " round " << round << " face " << f;
    }
  }
}

// ---- silhouettes
// --------------------------------------------------------------------------------------------------------

TEST(FindSilhouettes, OfATriangle) {
  const TriangleMesh mesh = make_triangle({0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  const DiskLight above{{0, 5, 0}, {0, -1, 0}, 0.5};
  const Silhouettes s = find_silhouettes(mesh, classify_faces(mesh, above));
  EXPECT_EQ(s.umbra.size(), 3u);
  EXPECT_EQ(s.penumbra.size(), 3u);
  EXPECT_EQ(s.band.size(), 3u);
  const DiskLight beside{{5, 0, 0}, {-1, 0, 0}, 0.5};  // sees both sides: mixed
  const Silhouettes mixed = find_silhouettes(mesh, classify_faces(mesh, beside));
  EXPECT_TRUE(mixed.umbra.empty());
  EXPECT_TRUE(mixed.penumbra.empty());
  EXPECT_EQ(mixed.band.size(), 3u);
}

/// Edges leaving minus edges arriving, the face that `looks` on the left.
template <class Looks>
std::vector<int> imbalance(const TriangleMesh& mesh, const std::vector<EdgeId>& silhouette, Looks looks) {
  std::vector<int> result(mesh.positions().size(), 0);
  for (const EdgeId id : silhouette) {
    const Edge& edge = mesh.edges()[index(id)];
    const int sign = looks(edge.left) ? 1 : -1;
    result[index(edge.from)] += sign;
    result[index(edge.to)] -= sign;
  }
  return result;
}

TEST(FindSilhouettes, LoopsCloseAndLinesMissTheDiskOnEveryMesh) {
  for (const auto& file : testing::mesh_files()) {
    const TriangleMesh mesh = read_mesh(file);
    const Bounds bounds = bounds_of(mesh.positions());
    for (const double size : {0.01, 0.3, 1.5}) {
      const Vec3 center = bounds.center() + bounds.radius() * Vec3(0.4, 2.0, 0.3);
      const DiskLight light{center, {-0.2, -1, -0.1}, size * bounds.radius()};
      const Classification classes = classify_faces(mesh, light);
      const Silhouettes s = find_silhouettes(mesh, classes);
      ASSERT_EQ(classes.all_front + classes.mixed + classes.none_front, mesh.triangles().size());
      for (const auto* list : {&s.umbra, &s.penumbra}) {
        for (const EdgeId id : *list) {
          const Edge& edge = mesh.edges()[index(id)];
          ASSERT_EQ(line_outside_disk(mesh.position(edge.from), mesh.position(edge.to), light),
                    Sign::kPositive)
              << file << " edge " << index(id);
        }
        ASSERT_TRUE(std::includes(s.band.begin(), s.band.end(), list->begin(), list->end())) << file;
      }
      if (!mesh.is_closed()) continue;
      const auto front = [&](FaceId f) { return classes.faces[index(f)] == FaceClass::kAllFront; };
      const auto not_back = [&](FaceId f) { return classes.faces[index(f)] != FaceClass::kNoneFront; };
      for (const int d : imbalance(mesh, s.penumbra, front)) ASSERT_EQ(d, 0) << file;
      for (const int d : imbalance(mesh, s.umbra, not_back)) ASSERT_EQ(d, 0) << file;
    }
  }
}

}  // namespace
}  // namespace penumbra
