// Means over faces and around vertices.
#include "penumbra/render/bake/face_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/shapes.h"

namespace penumbra {
namespace {

/// A floor of two triangles, 2 by 2, and a plate high above whose shadow ends at x = `edge` under a light
/// from above.
std::vector<SceneObject> half_shadowed(double edge) {
  const std::vector<Vec3> floor{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  const std::vector<Vec3> plate{{-9, 3, -9}, {edge, 3, -9}, {edge, 3, 9}, {-9, 3, 9}};
  const std::vector<IndexedTriangle> faces{{0, 2, 1}, {0, 3, 2}};
  return {{.name = "floor", .mesh = TriangleMesh::build(floor, faces)},
          {.name = "plate", .mesh = TriangleMesh::build(plate, faces)}};
}

/// From above, with a penumbra of 1/200.
const std::vector<Light> kAbove{{.shape = DistantLight{{0, -1, 0}, 0.1}}};

std::vector<float> baked(double edge, const FaceMeansOptions& options) {
  const Casters casters(half_shadowed(edge));
  return bake_faces({.casters = casters, .lights = kAbove}, 0, options).at(0);
}

TEST(FaceMeans, FacesGetTheirShareOfLight) {
  const std::vector<float> lit = baked(0.0, {.side = 32});
  ASSERT_EQ(lit.size(), 2u);
  // The diagonal from (-1, -1) to (1, 1) leaves 3/4 of the first triangle on the lit side, and 1/4 of the
  // second.
  EXPECT_NEAR(lit[0], 0.75, 0.02);
  EXPECT_NEAR(lit[1], 0.25, 0.02);
}

TEST(FaceMeans, VerticesGetTheMeanAroundThem) {
  const std::vector<float> lit = baked(0.0, {.place = BakePlace::kVertices, .side = 32});
  ASSERT_EQ(lit.size(), 4u);
  // Of the vertex at (1, -1), whose hat function on its one triangle is (x - z) / 2: the integral over x > 0
  // is 7/12, of 8/12 in all.
  EXPECT_NEAR(lit[1], 0.875, 0.02);
  EXPECT_NEAR(lit[3], 0.125, 0.02);
  EXPECT_NEAR(lit[0] + lit[2], 1.0, 0.02);
}

TEST(FaceMeans, EverywhereLitIsOneAndHiddenIsZero) {
  for (const BakePlace place : {BakePlace::kFaces, BakePlace::kVertices}) {
    for (const float value : baked(-8.0, {.place = place, .side = 3})) EXPECT_EQ(value, 1.0f);
    for (const float value : baked(8.0, {.place = place, .side = 3})) EXPECT_EQ(value, 0.0f);
  }
}

TEST(FaceMeans, LightOnTheBackIsSeenFromThere) {
  const Casters casters(half_shadowed(-8.0));
  const auto lit = bake_faces({.casters = casters, .lights = kAbove, .backs = {0}}, 0);
  EXPECT_EQ(lit[0], (std::vector<float>{0.0f, 0.0f}));
}

TEST(FaceMeans, IrradianceIsThatOfTheLight) {
  const Casters casters(half_shadowed(-8.0));
  // A small disk of radiance 5, far above: E = 5 · area / distance².
  const std::vector<Light> lights{{.shape = DiskLight{{0, 200, 0}, {0, -1, 0}, 0.5}, .radiance = {5, 10, 0}}};
  const double factor = std::numbers::pi / 4.0 / 40000.0;
  const auto lit = bake_faces({.casters = casters, .lights = lights, .quantity = BakeQuantity::kIrradiance},
                              0, {.side = 4});
  ASSERT_EQ(lit.size(), 3u);
  EXPECT_NEAR(lit[0][0], 5.0 * factor, 1e-3 * factor);
  EXPECT_NEAR(lit[1][0], 10.0 * factor, 1e-3 * factor);
  EXPECT_EQ(lit[2][0], 0.0f);
}

TEST(FaceMeans, PartsMakeNoDifference) {
  const Casters casters({{.name = "ball", .mesh = make_icosphere({0, 1, 0}, 1, 2)}});
  const std::vector<Light> lights{{.shape = DiskLight{{0, 4, 0}, {0, -1, 0}, 1}}};
  const BakeSource source{.casters = casters, .lights = lights};
  for (const BakePlace place : {BakePlace::kFaces, BakePlace::kVertices}) {
    const auto whole = bake_faces(source, 0, {.place = place});
    const auto parts = bake_faces(source, 0, {.place = place, .part = 7});
    for (std::size_t i = 0; i < whole[0].size(); ++i) EXPECT_NEAR(whole[0][i], parts[0][i], 1e-3);
  }
}

TEST(FaceMeans, RefusesValuesOfAnotherBake) {
  const Casters casters(half_shadowed(0.0));
  const BakeSource source{.casters = casters, .lights = kAbove};
  EXPECT_THROW(FaceMeans(source, 0).finish([](std::size_t) { return std::vector<float>(5); }), UsageError);
  EXPECT_THROW(FaceMeans(source, 7), UsageError);
}

}  // namespace
}  // namespace penumbra
