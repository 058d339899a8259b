// What scenes take over from mesh files: colors of materials, and what is said about the rest.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;

class MeshFilesTest : public testing::Test {
 protected:
  MeshFilesTest() : folder_(fs::temp_directory_path() / ("penumbra-mesh-files-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    write("c.mtl", "newmtl red\nKd 1 0 0\nnewmtl also_red\nKd 1 0 0\nnewmtl blue\nKd 0 0 .5\n");
  }
  ~MeshFilesTest() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// A square of two triangles, of these materials.
  fs::path square(const std::string& first, const std::string& second) const {
    return write("square.obj", "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n" + first + "\nf 1 2 3\n" +
                                   second + "\nf 1 3 4\n");
  }
  LoadedScene scene(const nlohmann::json& keys) const {
    nlohmann::json document = nlohmann::json::parse(R"({"version":1, "objects":[{}],
      "lights":[{"shape":"disk","center":[0,4,0],"normal":[0,-2,0],"radius":0.5,"radiance":[1,2,3]}]})");
    document["objects"][0] = keys;
    document["objects"][0]["mesh"] = "square.obj";
    return parse_scene(document.dump(), folder_, "s.json");
  }

  fs::path folder_;
};

TEST_F(MeshFilesTest, OneColorIsTheAlbedo) {
  square("usemtl red", "usemtl also_red");
  const SceneObject object = scene({}).scene.objects[0];
  EXPECT_EQ(object.albedo, Vec3(1, 0, 0));
  EXPECT_TRUE(object.face_albedo.of_face.empty());
}

TEST_F(MeshFilesTest, SeveralColorsAreThoseOfFaces) {
  square("usemtl red", "usemtl blue");
  const LoadedScene loaded = scene({});
  const SceneObject object = loaded.scene.objects[0];
  EXPECT_EQ(object.albedo_of(0), Vec3(1, 0, 0));
  EXPECT_EQ(object.albedo_of(1), Vec3(0, 0, .5));
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST_F(MeshFilesTest, FacesWithoutColorKeepTheDefault) {
  square("", "usemtl blue");
  EXPECT_EQ(scene({}).scene.objects[0].albedo_of(0), Vec3(.8));
  square("usemtl unknown", "usemtl blue");
  EXPECT_EQ(scene({}).scene.objects[0].albedo_of(0), Vec3(.8));
  square("usemtl unknown", "usemtl unknown");
  EXPECT_EQ(scene({}).scene.objects[0].albedo, Vec3(.8));
}

TEST_F(MeshFilesTest, TheScenesAlbedoCountsFirst) {
  square("usemtl red", "usemtl blue");
  const SceneObject object = scene({{"albedo", 0.25}}).scene.objects[0];
  EXPECT_EQ(object.albedo_of(0), Vec3(.25));
  EXPECT_EQ(object.albedo_of(1), Vec3(.25));
}

TEST_F(MeshFilesTest, ABareMeshHasItsColors) {
  const Scene bare = load_scene(square("usemtl red", "usemtl blue")).scene;
  EXPECT_EQ(bare.objects.back().albedo_of(0), Vec3(1, 0, 0));
  EXPECT_EQ(bare.objects.back().albedo_of(1), Vec3(0, 0, .5));
  EXPECT_FALSE(nlohmann::json::parse(bare.document)["objects"][0].contains("albedo"))
      << "saved and read again it keeps them";
}

TEST_F(MeshFilesTest, NormalsGoWithTheObject) {
  // A corner without normal, and a component that is turned outward: corners 1 and 2 of its faces change
  // places.
  write("square.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn -1 -1 -1\nvn 3 0 0\nvn 0 1 0\nvn 0 0 1\n"
        "f 1//1 2//2 3//3\nf 1//1 4//4 2//2\nf 1//1 3//3 4//4\nf 2//2 4 3//3\n");
  const SceneObject object = scene({{"scale", nlohmann::json::array({1, 2, -1})}}).scene.objects[0];
  ASSERT_EQ(object.corner_normals.size(), 4u);
  ASSERT_EQ(object.mesh.components()[0].signed_volume, 2.0 / 6.0);
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = object.mesh.positions()[object.mesh.triangles()[f][k]];
      const Vec3 n = object.corner_normals[f][k];
      EXPECT_NEAR(glm::length(n), 1.0, 1e-6);
      if (p == Vec3(1, 0, 0)) {
        EXPECT_EQ(std::abs(n.x), 1.0f);
      }
      if (p == Vec3(0, 2, 0)) {
        EXPECT_EQ(std::abs(n.y), 1.0f);
      }
      if (p == Vec3(0, 0, -1) && f < 3) {
        EXPECT_EQ(std::abs(n.z), 1.0f);
      }
      if (p == Vec3(0, 0, -1) && f == 3) {
        EXPECT_NEAR(std::abs(n.x / n.y), 2.0f, 1e-6f) << "the face's own";
      }
      if (p == Vec3(0.0)) {
        EXPECT_NEAR(n.x / n.y, 2.0f, 1e-6f) << "as the inverse transpose turns it";
      }
    }
  EXPECT_TRUE(scene({{"smooth", false}}).scene.objects[0].corner_normals.empty());
  EXPECT_EQ(load_scene(folder_ / "square.obj").scene.objects.back().corner_normals.size(), 4u);
}

TEST_F(MeshFilesTest, NormalsAreMadeWhereAFileHasNoneAndTheSceneAsks) {
  // Two faces that meet at 45 degrees, and one that stands upright on them.
  write("square.obj", "v 0 0 0\nv 1 0 0\nv 0 0 -1\nv 1 1 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 3 5 1\n");
  EXPECT_TRUE(scene({}).scene.objects[0].corner_normals.empty());
  EXPECT_TRUE(scene({{"smooth", false}}).scene.objects[0].corner_normals.empty());
  const auto normals = scene({{"smooth", true}}).scene.objects[0].corner_normals;
  ASSERT_EQ(normals.size(), 3u);
  EXPECT_EQ(normals[0][0], normals[1][0]);
  EXPECT_NE(normals[0][0], normals[0][2]);
  EXPECT_EQ(normals[2][0], normals[2][2]);
  for (const auto& corners : normals)
    for (const glm::vec3& n : corners) EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
}

TEST_F(MeshFilesTest, WarnsOfWhatIsIgnored) {
  write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\n");
  const LoadedScene loaded = scene({});
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("ignored its texture coordinates"), std::string::npos)
      << loaded.warnings[0];
}

}  // namespace
}  // namespace penumbra
