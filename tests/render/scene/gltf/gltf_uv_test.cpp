// Texture coordinates of glTF files, against tests/data/gltf/make.py, which computes them by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "penumbra/render/scene/scene.h"

namespace penumbra {
namespace {

using Json = nlohmann::json;

const std::filesystem::path kFile =
    std::filesystem::path(PENUMBRA_SOURCE) / "tests/data/gltf/arrays/texture_places.glb";

Json expected_object() {
  std::ifstream in(std::filesystem::path(kFile).replace_extension(".expected.json"));
  return Json::parse(in)["objects"][0];
}

/// Which corner of the expected triangle lies at p.
std::size_t corner_at(const Json& triangle, const Vec3& p) {
  for (std::size_t k = 0; k < 3; ++k)
    if (glm::length(p - Vec3(triangle[3 * k], triangle[3 * k + 1], triangle[3 * k + 2])) < 1e-6) return k;
  return 3;
}

TEST(GltfUv, CornersHaveThoseOfTheSetThatIsAskedFor) {
  const SceneObject object = load_scene(kFile, {.uv_set = 1}).scene.objects.at(0);
  const Json expected = expected_object();
  ASSERT_EQ(object.corner_uv.size(), object.mesh.triangles().size());
  std::size_t with = 0;
  for (std::size_t f = 0; f < object.corner_uv.size(); ++f) {
    const std::uint32_t source = object.mesh.source_triangles()[f];
    const Json& uv = expected["uv"][source];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2& read = object.corner_uv[f][k];
      const std::size_t corner =
          corner_at(expected["triangles"][source], object.mesh.positions()[object.mesh.triangles()[f][k]]);
      ASSERT_LT(corner, 3u);
      if (uv.is_null()) {
        EXPECT_TRUE(std::isnan(read.x)) << "this primitive has no second set";
        continue;
      }
      EXPECT_NEAR(read.x, double{uv[corner][0]}, 1e-12);
      EXPECT_NEAR(read.y, double{uv[corner][1]}, 1e-12);
      ++with;
    }
  }
  EXPECT_EQ(with, 12u);
}

TEST(GltfUv, NoneAreReadUnlessAskedFor) {
  EXPECT_TRUE(load_scene(kFile).scene.objects.at(0).corner_uv.empty());
  EXPECT_TRUE(load_scene(kFile, {.uv_set = 2}).scene.objects.at(0).corner_uv.empty());
  EXPECT_EQ(load_scene(kFile, {.uv_set = 0}).scene.objects.at(0).corner_uv[0][0], glm::dvec2(2.0, -3.0));
}

}  // namespace
}  // namespace penumbra
