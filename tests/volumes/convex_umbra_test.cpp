#include "penumbra/volumes/convex_umbra.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>

#include "penumbra/mesh/shapes.h"
#include "penumbra/volumes/volumes.h"
#include "tests/volumes/triangle_tree.h"
#include "tests/volumes/umbra_oracle.h"
#include "volumes/cells/solid_shape.h"

namespace penumbra {
namespace {

const DiskLight kLight{{0, 10, 0}, {0, -1, 0}, 0.8};

ShadowMesh umbra_of(const TriangleMesh& mesh, const DiskLight& light) {
  return convex_umbra(mesh, light, classify_faces(mesh, light));
}

int winding_at(const ShadowMesh& volume, const DiskLight& light, const Vec3& x) {
  testing::RandomInputs random(1);
  const testing::TriangleTree tree(volume.positions, volume.triangles);
  return testing::winding_number(tree, x, light.center - light_frame(light).w, 0.1, random);
}

void expect_closed(const ShadowMesh& volume) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const IndexedTriangle& t : volume.triangles) {
    for (int i = 0; i < 3; ++i) ++balance[{t[i], t[(i + 1) % 3]}], --balance[{t[(i + 1) % 3], t[i]}];
  }
  for (const auto& [edge, count] : balance) ASSERT_EQ(count, 0) << edge.first << " → " << edge.second;
  EXPECT_EQ(volume.tags.size(), volume.triangles.size());
}

/// Turned about two axes, so that nothing stays parallel to an axis.
TriangleMesh moved(const TriangleMesh& mesh, const Vec3& along, double angle) {
  std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
  const double c = std::cos(angle), s = std::sin(angle);
  for (Vec3& p : positions) {
    const Vec3 q(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
    p = Vec3(q.x, c * q.y - s * q.z, s * q.y + c * q.z) + along;
  }
  return TriangleMesh::build(positions, mesh.triangles());
}

TriangleMesh joined(const std::vector<TriangleMesh>& meshes) {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), mesh.positions().begin(), mesh.positions().end());
    for (const IndexedTriangle& t : mesh.triangles())
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return TriangleMesh::build(positions, triangles);
}

// ---- shapes of solids

detail::SolidKind kind_of(const TriangleMesh& mesh) {
  return detail::shape_of_solid(mesh, mesh.components().front()).kind;
}

TEST(ShapeOfSolid, TellsConvexFromStarShapedFromOther) {
  EXPECT_EQ(kind_of(make_box({1, 2, 3}, {0.5, 1, 2})), detail::SolidKind::kConvex);
  EXPECT_EQ(kind_of(make_icosphere({1, 2, 3}, 0.7, 3)), detail::SolidKind::kConvex);
  EXPECT_EQ(kind_of(make_cylinder({0, 5, 0}, 0.5, 1.0, 24)), detail::SolidKind::kConvex);
  EXPECT_EQ(kind_of(make_torus({0, 0, 0}, 1, 0.3, 16, 8)), detail::SolidKind::kOther);
  EXPECT_EQ(kind_of(make_plane(1.0)), detail::SolidKind::kOther);
}

TEST(ShapeOfSolid, OneUlpInwardIsNotConvex) {
  const TriangleMesh box = make_box({0, 0, 0}, {1, 1, 1});
  int convex = 0;
  for (std::size_t v = 0; v < box.positions().size(); ++v) {
    std::vector<Vec3> positions(box.positions().begin(), box.positions().end());
    positions[v].x = std::nextafter(positions[v].x, 0.0);
    const detail::SolidKind kind = kind_of(TriangleMesh::build(positions, box.triangles()));
    EXPECT_NE(kind, detail::SolidKind::kOther);  // which it is depends on the diagonals at the corner
    convex += kind == detail::SolidKind::kConvex;
  }
  EXPECT_GT(convex, 0);
  EXPECT_LT(convex, 8);
}

/// Five faces round each tip, going round twice: it bends inward nowhere, yet is no boundary of a convex
/// body.
TEST(ShapeOfSolid, AStarThatWindsTwiceIsNotConvex) {
  std::vector<Vec3> p{{0, 1, 0}, {0, -1, 0}};
  std::vector<IndexedTriangle> t;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2.0 * 2.0 * 3.14159265358979 * i / 5;
    p.push_back({std::cos(angle), 0, -std::sin(angle)});
  }
  for (std::uint32_t i = 0; i < 5; ++i) {
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % 5;
    t.push_back({0, a, b});
    t.push_back({1, b, a});
  }
  const TriangleMesh mesh = TriangleMesh::build(p, t);
  ASSERT_TRUE(mesh.is_closed());
  EXPECT_EQ(kind_of(mesh), detail::SolidKind::kOther);
}

/// A random hull whose first face is a sliver, some 1e-16 wide: no direction can be told from it.
TEST(SolidShape, OfAConvexSolidThatBeginsWithASliver) {
  const std::vector<Vec3> p{{0.38687828679714409, 3.6103796871219762, -1.5530990471050756},
                            {2.3868782867971441, 5.6103796871219762, -0.55309904710507563},
                            {0.88687828679714409, 3.6103796871219762, -1.5530990471050756},
                            {0.38687828679714409, 3.6103796871219762, -2.0530990471050758},
                            {0.38687828679714409, 4.6103796871219762, -2.5530990471050758},
                            {1.8868782867971441, 5.6103796871219762, -2.5530990471050758},
                            {2.3868782867971441, 4.1103796871219762, -2.5530990471050758},
                            {0.38687828679714409, 5.1103796871219762, -0.55309904710507563},
                            {0.38687828679714409, 4.1103796871219762, -0.55309904710507563},
                            {2.3868782867971441, 3.6103796871219762, -2.5530990471050758},
                            {1.8868782867971441, 5.6103796871219762, -1.5530990471050756},
                            {1.3868782867971441, 5.6103796871219762, -2.5530990471050758},
                            {1.8868782867971441, 3.6103796871219762, -0.55309904710507563},
                            {2.3868782867971441, 4.6103796871219762, -0.55309904710507563}};
  const std::vector<IndexedTriangle> t{
      {1, 11, 10}, {9, 11, 5}, {11, 1, 5}, {1, 9, 6},  {9, 5, 6},   {5, 1, 6},  {11, 9, 4},  {9, 3, 4},
      {3, 9, 12},  {3, 12, 2}, {12, 1, 7}, {1, 10, 7}, {10, 11, 7}, {11, 4, 7}, {4, 3, 7},   {12, 7, 8},
      {7, 3, 8},   {2, 12, 0}, {12, 8, 0}, {3, 2, 0},  {8, 3, 0},   {9, 1, 13}, {1, 12, 13}, {12, 9, 13}};
  EXPECT_EQ(kind_of(TriangleMesh::build(p, t)), detail::SolidKind::kConvex);
}

// ---- umbras

TEST(ConvexUmbra, OfABoxUnderAPointLightIsTheHardVolume) {
  const DiskLight point{{0, 10, 0}, {0, -1, 0}, 0.0};
  const ShadowMesh umbra = umbra_of(make_box({0, 5, 0}, Vec3(1.0)), point);
  EXPECT_EQ(umbra.guarantee, Guarantee::kExact);
  expect_closed(umbra);
  EXPECT_EQ(winding_at(umbra, point, {2.4, 0.1, 2.4}), 1);  // the top, y = 6, doubles its size at y = 2 ...
  EXPECT_EQ(winding_at(umbra, point, {2.5, 0.1, 2.5}), 0);
  EXPECT_EQ(winding_at(umbra, point, {0, 5, 0}), 1);
  EXPECT_EQ(winding_at(umbra, point, {0, 7, 0}), 0);
  EXPECT_EQ(winding_at(umbra, point, {0, -26, 0}), 1);  // as far as the bound, 7 - 10 √11
}

TEST(ConvexUmbra, NarrowsUnderALightLargerThanTheCaster) {
  const DiskLight large{{0, 10, 0}, {0, -1, 0}, 2.0};
  const ShadowMesh umbra = umbra_of(make_box({0, 5, 0}, Vec3(1.0)), large);
  expect_closed(umbra);
  for (const ShadowTag& tag : umbra.tags) EXPECT_NE(tag.kind, ShadowKind::kFarCap);
  // Planes from the rim, x = 2 at y = 10, through the bottom's edges, x = 1 at y = 4, meet at y = -2.
  EXPECT_EQ(winding_at(umbra, large, {0, -1.999, 0}), 1);
  EXPECT_EQ(winding_at(umbra, large, {0, -2.001, 0}), 0);
}

/// Without the caps the umbra would reach up to the planes' own edge above the roof.
TEST(ConvexUmbra, IsCappedByFacesThatSeeSomeOfTheLight) {
  const TriangleMesh box = make_box({2, 5, 0}, Vec3(1.0));
  const ShadowMesh umbra = umbra_of(box, kLight);
  expect_closed(umbra);
  std::map<ShadowKind, int> kinds;
  for (const ShadowTag& tag : umbra.tags) ++kinds[tag.kind];
  EXPECT_GT(kinds[ShadowKind::kUmbraCap], 0);
  EXPECT_GT(kinds[ShadowKind::kUmbraFacet], 0);
  EXPECT_GT(kinds[ShadowKind::kFarCap], 0);
  testing::UmbraOracle oracle(box, kLight);
  testing::RandomInputs random(3);
  int dark = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x(random.uniform(0.5, 5), random.uniform(0, 7), random.uniform(-2, 2));
    ASSERT_EQ(winding_at(umbra, kLight, x) >= 1, oracle.is_wholly_hidden(x));
    dark += oracle.is_wholly_hidden(x);
  }
  EXPECT_GT(dark, 200);
}

TEST(ConvexUmbra, IsTheBodyWhereEveryFaceSeesSomeOfTheLight) {
  const DiskLight huge{{0, 10, 0}, {0, -1, 0}, 1000.0};
  const ShadowMesh umbra = umbra_of(make_icosphere({0, 5, 0}, 1.0, 2), huge);
  EXPECT_EQ(umbra.guarantee, Guarantee::kExact);
  EXPECT_EQ(winding_at(umbra, huge, {0, 4.5, 0}), 1);
  EXPECT_EQ(winding_at(umbra, huge, {0, 3.9, 0}), 0);
}

TEST(ConvexUmbra, OfAFineSphere) {
  const TriangleMesh sphere = make_icosphere({-0.3, 5, 0.1}, 1.0, 4);
  const ShadowMesh umbra = umbra_of(sphere, kLight);
  EXPECT_EQ(umbra.guarantee, Guarantee::kExact);
  expect_closed(umbra);
  testing::UmbraOracle oracle(sphere, kLight);
  testing::RandomInputs random(4);
  for (int i = 0; i < 300; ++i) {
    const Vec3 x(random.uniform(-2, 2), random.uniform(0, 6), random.uniform(-2, 2));
    ASSERT_EQ(winding_at(umbra, kLight, x) >= 1, oracle.is_wholly_hidden(x));
  }
}

TEST(ConvexUmbra, OfABoxThatARotationRoundedIsContained) {
  int contained = 0;
  for (const double angle : {0.1, 0.3, 0.7, 1.1, 1.3}) {
    const TriangleMesh box = moved(make_box({0, 0, 0}, {1, 0.5, 0.7}), {0, 5, 0}, angle);
    const ShadowMesh umbra = umbra_of(box, kLight);
    expect_closed(umbra);
    contained += umbra.guarantee == Guarantee::kContained;
    EXPECT_EQ(umbra.cells, 1u);
    EXPECT_EQ(winding_at(umbra, kLight, {0, 3, 0}), 1);
    EXPECT_EQ(winding_at(umbra, kLight, {3, 3, 0}), 0);
  }
  EXPECT_GT(contained, 0) << "none of these boxes is rounded inward";
}

TEST(ConvexUmbra, OfSeveralBodiesIsTheirUnionAndContained) {
  const TriangleMesh two = joined({make_box({-2, 5, 0}, Vec3(0.8)), make_box({2, 5, 0}, Vec3(0.8))});
  const ShadowMesh umbra = umbra_of(two, kLight);
  EXPECT_EQ(umbra.guarantee, Guarantee::kContained);
  EXPECT_EQ(umbra.cells, 2u);
  expect_closed(umbra);
  EXPECT_EQ(winding_at(umbra, kLight, {-2.2, 3.5, 0}), 1);
  EXPECT_EQ(winding_at(umbra, kLight, {2.2, 3.5, 0}), 1);
  EXPECT_EQ(winding_at(umbra, kLight, {0, 3.5, 0}), 0);
}

TEST(ConvexUmbra, OfOtherCastersIsEmptyAndContained) {
  for (const TriangleMesh& mesh : {make_torus({0, 5, 0}, 1, 0.3, 16, 8), make_plane(1.0),
                                   make_box({0, 10, 0}, Vec3(1.0)), make_box({0, 15, 0}, Vec3(1.0))}) {
    const ShadowMesh umbra = umbra_of(mesh, kLight);
    EXPECT_TRUE(umbra.triangles.empty());
    EXPECT_EQ(umbra.guarantee, Guarantee::kContained);
  }
}

TEST(ConvexUmbra, TagsNameTheirSources) {
  const TriangleMesh box = make_box({0.3, 5, 0.2}, Vec3(1.0));
  const Classification classes = classify_faces(box, kLight);
  ExtrudeOptions options;
  options.object = 7;
  const ShadowMesh umbra = convex_umbra(box, kLight, classes, options);
  for (const ShadowTag& tag : umbra.tags) {
    EXPECT_EQ(tag.object, 7u);
    if (tag.kind == ShadowKind::kUmbraCap) {
      EXPECT_NE(classes.faces[tag.source], FaceClass::kNoneFront);
    }
    if (tag.kind == ShadowKind::kUmbraFacet) {
      EXPECT_LT(tag.source, box.edges().size());
    }
  }
}

TEST(ConvexUmbra, StaysFiniteAtEveryScale) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    for (const Vec3& far : {Vec3(0.0), Vec3(1e7, 0, 0) * scale}) {
      const DiskLight light{far + scale * Vec3(0, 10, 0), {0.1, -1, 0}, 0.8 * scale};
      const ShadowMesh umbra = umbra_of(make_icosphere(far + scale * Vec3(0.2, 5, 0), scale, 2), light);
      expect_closed(umbra);
      EXPECT_EQ(umbra.cells, 1u);
      for (const Vec3& p : umbra.positions)
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      EXPECT_EQ(winding_at(umbra, light, far + scale * Vec3(0.3, 3.5, 0)), 1);
    }
  }
}

}  // namespace
}  // namespace penumbra
