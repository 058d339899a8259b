#include "volumes/cells/inverted_folds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/extrude.h"
#include "tests/volumes/convex_pieces.h"
#include "tests/volumes/shadow_oracle.h"

namespace penumbra {
namespace {

std::vector<FaceId> folds_of(const TriangleMesh& mesh) {
  const Component& component = mesh.components().front();
  return detail::faces_of_inverted_folds(mesh, component, detail::FaceTree(mesh, component.faces));
}

/// A sphere whose lowest point is pushed up, and if `height` is above 2 through the top: what sticks out
/// there is inside out.
TriangleMesh pushed_sphere(double height) {
  const TriangleMesh sphere = make_icosphere(Vec3(0.0), 1.0, 4);
  std::vector<Vec3> positions(sphere.positions().begin(), sphere.positions().end());
  for (Vec3& p : positions) {
    const double from_axis = std::hypot(p.x - 0.01, p.z - 0.02);
    if (p.y < 0.0 && from_axis < 0.4) p.y += height * (1.0 - from_axis / 0.4);
  }
  return TriangleMesh::build(positions, sphere.triangles());
}

/// The triangles that wind about x, once each.
int winding_at(const TriangleMesh& mesh, const Vec3& x) {
  testing::RandomInputs random(1);
  return testing::winding_number(testing::TriangleTree(mesh.positions(), mesh.triangles()), x, {0.3, 9, 0.2},
                                 0.1, random);
}

TEST(InvertedFolds, OfSurfacesThatDoNotCrossThemselvesAreNone) {
  EXPECT_TRUE(folds_of(make_icosphere(Vec3(0.0), 1.0, 3)).empty());
  EXPECT_TRUE(folds_of(make_torus(Vec3(0.0), 1.0, 0.3, 24, 12)).empty());
  EXPECT_TRUE(folds_of(make_box(Vec3(0.0), Vec3(1.0))).empty());
  EXPECT_TRUE(folds_of(pushed_sphere(1.5)).empty()) << "a deep dent";
}

TEST(InvertedFolds, OfASpherePushedThroughItself) {
  const TriangleMesh mesh = pushed_sphere(2.5);
  ASSERT_EQ(mesh.components().size(), 1u);
  ASSERT_TRUE(mesh.is_closed());
  EXPECT_EQ(winding_at(mesh, {0.01, 1.1, 0.02}), -1);
  const std::vector<FaceId> folds = folds_of(mesh);
  EXPECT_TRUE(std::is_sorted(folds.begin(), folds.end()));
  EXPECT_GT(folds.size(), 10u);
  EXPECT_LT(folds.size(), mesh.triangles().size() / 4);
  // All that sticks out belongs to the fold, and nothing of the lower half's outside does.
  for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
    const IndexedTriangle& t = mesh.triangles()[f];
    const Vec3 middle = (mesh.positions()[t[0]] + mesh.positions()[t[1]] + mesh.positions()[t[2]]) / 3.0;
    const bool in_fold = std::binary_search(folds.begin(), folds.end(), static_cast<FaceId>(f));
    const bool sticks_out = middle.y > 1.05, is_below = middle.y < -0.1 && glm::length(middle) > 0.9;
    EXPECT_TRUE(in_fold || !sticks_out) << f;
    EXPECT_FALSE(in_fold && is_below) << f;
  }
}

/// In the fold light comes through faces that look away from it, and through no others.
TEST(InvertedFolds, AreInsideOfThePenumbraVolume) {
  const TriangleMesh mesh = pushed_sphere(2.5);
  const CircularLight sun = DistantLight{{0.05, -1, 0.02}, 0.5};
  const ShadowMesh volume = extrude_penumbra(mesh, sun, classify_faces(mesh, sun));
  testing::ConvexPieces pieces(volume.positions, volume.triangles, sun);
  testing::ShadowOracle oracle(mesh, sun);
  testing::RandomInputs random(2);
  int inverted = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Vec3 x = Vec3(0.01, 1.2, 0.02) + Vec3(0.1, 0.3, 0.1) * random.uniform_point();
    if (!oracle.is_partly_hidden(x)) continue;
    inverted += winding_at(mesh, x) < 0;
    ASSERT_GE(pieces.winding_number(x, 1), 1) << "point " << i;
  }
  EXPECT_GT(inverted, 50);
}

/// A real mesh with folds 1e-8 of its size wide, and a point in one of them.
TEST(InvertedFolds, OfDogHouse) {
  const TriangleMesh raw = read_mesh(std::filesystem::path(PENUMBRA_DATA) / "meshes" / "dog-house.ply");
  std::vector<Vec3> positions;
  for (const Vec3& p : raw.positions())
    positions.push_back((p - raw.bounds().center()) / raw.bounds().radius());
  const TriangleMesh mesh = TriangleMesh::build(positions, raw.triangles());
  const CircularLight sun = DistantLight{{3.0, -1.0, -1.5}, 10.0};
  const ShadowMesh volume = extrude_penumbra(mesh, sun, classify_faces(mesh, sun));
  const Vec3 x(0.14023045629968992, -0.085089312623351079, 0.57738654926778898);
  ASSERT_TRUE(testing::ShadowOracle(mesh, sun).is_partly_hidden(x));
  EXPECT_GE(testing::ConvexPieces(volume.positions, volume.triangles, sun).winding_number(x), 1);
}

}  // namespace
}  // namespace penumbra
