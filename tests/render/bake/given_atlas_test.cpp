// Texture coordinates that meshes bring along as an atlas.
#include <gtest/gtest.h>

#include <limits>

#include "penumbra/mesh/error.h"
#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra {
namespace {

/// A square of two faces that covers the left half of the texture.
SceneObject square() {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  const std::vector<IndexedTriangle> faces{{0, 2, 1}, {0, 3, 2}};
  const glm::dvec2 uv[4] = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {0.0, 1.0}};
  SceneObject object{.name = "square", .mesh = TriangleMesh::build(points, faces)};
  for (const IndexedTriangle& t : object.mesh.triangles())
    object.corner_uv.push_back({uv[t[0]], uv[t[1]], uv[t[2]]});
  return object;
}

void move_right(SceneObject& object, double by) {
  for (auto& face : object.corner_uv)
    for (glm::dvec2& p : face) p.x += by;
}

std::string refusal_of(const std::vector<SceneObject>& objects, const AtlasOptions& options = {}) {
  try {
    given_atlas(objects, options);
  } catch (const UsageError& e) {
    return e.what();
  }
  return {};
}

TEST(GivenAtlas, HasTheCoordinatesInTexels) {
  const std::vector<SceneObject> objects{square()};
  const TextureAtlas atlas = given_atlas(objects, {.size = 64});
  EXPECT_EQ(atlas.width, 64);
  EXPECT_EQ(atlas.height, 64);
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(atlas.uv[0][f][k], 64.0 * objects[0].corner_uv[f][k]);
}

TEST(GivenAtlas, AFaceWithoutAreaGetsNoTexel) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  SceneObject object{.name = "line",
                     .mesh = TriangleMesh::build(points, std::vector<IndexedTriangle>{{0, 1, 2}})};
  object.corner_uv.push_back({glm::dvec2(0.0), glm::dvec2(1.0, 0.0), glm::dvec2(0.0, 1.0)});
  const TextureAtlas atlas = given_atlas({object}, {.size = 64});
  for (const glm::dvec2& p : atlas.uv[0][0]) EXPECT_EQ(p, glm::dvec2(0.0));
}

TEST(GivenAtlas, TwoObjectsSideBySideAreTaken) {
  std::vector<SceneObject> objects{square(), square()};
  move_right(objects[1], 0.5);
  EXPECT_EQ(refusal_of(objects), "");
}

TEST(GivenAtlas, OverlapsAreNamed) {
  std::vector<SceneObject> objects{square(), square()};
  move_right(objects[1], 0.25);
  const std::string why = refusal_of(objects);
  EXPECT_NE(why.find("object 0 (square)"), std::string::npos) << why;
  EXPECT_NE(why.find("object 1 (square)"), std::string::npos) << why;
  EXPECT_NE(why.find("lie on each other"), std::string::npos) << why;
  EXPECT_EQ(refusal_of(objects, {.objects = {1}}), "") << "the other one is not baked";
}

TEST(GivenAtlas, FacesWithoutPlaceAreNamed) {
  std::vector<SceneObject> objects{square(), square()};
  move_right(objects[1], 0.75);
  EXPECT_NE(refusal_of(objects).find("of object 1 (square) has no texture coordinates from 0 to 1"),
            std::string::npos);
  objects[1].corner_uv[1][2].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal_of(objects, {.objects = {1}}), "");
  objects[1].corner_uv.clear();
  EXPECT_NE(refusal_of(objects).find("object 1 (square) has no texture coordinates of this set"),
            std::string::npos);
}

}  // namespace
}  // namespace penumbra
