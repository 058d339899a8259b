#include "penumbra/render/scene/scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "penumbra/mesh/error.h"
#include "render/light/area_light.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
// Open, so that building does not turn it.
constexpr const char* kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

const DiskLight& disk_of(const Scene& scene) {
  return std::get<DiskLight>(scene.lights.at(0).shape);
}

class SceneTest : public testing::Test {
 protected:
  SceneTest() : folder_(fs::temp_directory_path() / ("penumbra-scene-" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "meshes");
    write("t.off", kTetrahedron);
    write("triangle.off", kTriangle);
  }
  ~SceneTest() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  LoadedScene parse(const Json& document, bool strict = false) const {
    return parse_scene(document.dump(), folder_, "s.json", {.strict = strict});
  }
  /// The first object of a scene whose first object has these keys besides `mesh`.
  SceneObject object(const Json& keys, const char* mesh = "triangle.off") const {
    Json document = good();
    document["objects"][0] = keys;
    document["objects"][0]["mesh"] = mesh;
    return parse(document).scene.objects[0];
  }
  static Json good() {
    return Json::parse(R"({"version":1,
      "lights":[{"shape":"disk","center":[0,4,0],"normal":[0,-2,0],"radius":0.5,"radiance":[1,2,3]}],
      "camera":{"eye":[3,3,5],"target":[0,0.5,0],"up":[0,1,0.5],"fov_y_degrees":33},
      "objects":[{"mesh":"t.off"}]})");
  }
  std::string message_of(const Json& document, bool strict = false) const {
    return message_of_text(document.dump(), strict);
  }
  std::string message_of_text(const std::string& text, bool strict = false) const {
    try {
      parse_scene(text, folder_, "s.json", {.strict = strict});
    } catch (const SceneError& e) {
      return e.what();
    }
    return "no SceneError";
  }

  fs::path folder_;
};

TEST_F(SceneTest, EverythingIsRead) {
  const LoadedScene loaded = parse(good());
  const Scene& scene = loaded.scene;
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(disk_of(scene).center, Vec3(0, 4, 0));
  EXPECT_EQ(disk_of(scene).normal, Vec3(0, -2, 0));  // its length is kept
  EXPECT_EQ(disk_of(scene).radius, 0.5);
  EXPECT_EQ(scene.lights.front().radiance, Vec3(1, 2, 3));
  EXPECT_EQ(scene.camera.eye, Vec3(3, 3, 5));
  EXPECT_EQ(scene.camera.target, Vec3(0, 0.5, 0));
  EXPECT_EQ(scene.camera.up, Vec3(0, 1, 0.5));
  EXPECT_EQ(scene.camera.fov_y_degrees, 33);
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].name, "t.off");
  EXPECT_EQ(scene.objects[0].albedo, Vec3(0.8));
  EXPECT_TRUE(scene.objects[0].casts);
  EXPECT_EQ(scene.objects[0].mesh.triangles().size(), 4u);
  EXPECT_EQ(Json::parse(scene.document), good());
}

TEST_F(SceneTest, RectangleIsRead) {
  Json document = good();
  document["lights"][0] = Json::parse(
      R"({"shape":"rectangle","center":[0,4,0],"normal":[0,-2,0],"tangent":[3,1,0],"half_extents":[0.3,0.4]})");
  const LoadedScene loaded = parse(document, true);
  const auto* rectangle = std::get_if<RectangleLight>(&loaded.scene.lights.at(0).shape);
  ASSERT_TRUE(rectangle);
  EXPECT_EQ(rectangle->tangent, Vec3(3, 1, 0));
  EXPECT_EQ(rectangle->half_extents, glm::dvec2(0.3, 0.4));
  EXPECT_NEAR(disk_around(loaded.scene.lights[0].shape).radius, 0.5, 1e-15);  // the disk around it
  const AreaLight light = area_light(*rectangle);
  EXPECT_FALSE(light.disk);
  EXPECT_LT(glm::distance(light.axes.u, Vec3(1, 0, 0)), 1e-15);  // its part in the light's plane
  EXPECT_LT(glm::distance(light.axes.w, Vec3(0, -1, 0)), 1e-15);
  EXPECT_LT(glm::distance(glm::cross(light.axes.u, light.axes.v), light.axes.w), 1e-15);
}

TEST_F(SceneTest, BadRectanglesAreRefusedByName) {
  Json document = good();
  Json& light = document["lights"][0];
  light = Json::parse(
      R"({"shape":"rectangle","center":[0,4,0],"normal":[0,-2,0],"tangent":[1,0,0],"half_extents":[0.3,0.4]})");
  const auto message_with = [&](const char* key, const Json& value) {
    Json changed = document;
    changed["lights"][0][key] = value;
    return message_of(changed, true);
  };
  EXPECT_NE(message_with("tangent", {0, 1, 0}).find("/lights/0/tangent"), std::string::npos);
  EXPECT_NE(message_with("tangent", {0, 0, 0}).find("/lights/0/tangent"), std::string::npos);
  for (const Json& bad : {Json{0.0, 1.0}, Json{1.0, -1.0}, Json{1.0}, Json(1.0)})
    EXPECT_NE(message_with("half_extents", bad).find("/lights/0/half_extents"), std::string::npos) << bad;
  EXPECT_NE(message_with("radius", 1.0).find("/lights/0/radius"), std::string::npos) << "a disk's key";
  EXPECT_NE(message_with("shape", "sphere").find("/lights/0/shape"), std::string::npos);
}

TEST_F(SceneTest, PositionsOfAnIdentityKeepEveryBit) {
  write("odd.off", "OFF\n3 1 0\n0.1 1e-300 3\n-7.3 0.3 1e99\n5 5 5e-324\n3 0 1 2\n");
  const SceneObject odd = object(Json::object(), "odd.off");
  EXPECT_EQ(odd.mesh.positions()[0], Vec3(0.1, 1e-300, 3));
  EXPECT_EQ(odd.mesh.positions()[1], Vec3(-7.3, 0.3, 1e99));
  EXPECT_EQ(odd.mesh.positions()[2], Vec3(5, 5, 5e-324));
}

TEST_F(SceneTest, TransformIsTranslationRotationScale) {
  const double h = std::sqrt(0.5);
  // Scale by (2, 3, 4), then a quarter turn about z (x to y, y to -x), then move.
  const SceneObject t =
      object({{"translation", {10, 20, 30}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}});
  EXPECT_LT(glm::distance(t.mesh.positions()[1], Vec3(10, 22, 30)), 1e-14);
  EXPECT_LT(glm::distance(t.mesh.positions()[2], Vec3(7, 20, 30)), 1e-14);
  EXPECT_EQ(object({{"scale", 2}}).mesh.positions()[1], Vec3(2, 0, 0));
}

TEST_F(SceneTest, MatrixIsColumnMajor) {
  const SceneObject t = object({{"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1}}});
  EXPECT_EQ(t.mesh.positions()[1], Vec3(10, 21, 30));
  EXPECT_EQ(t.mesh.positions()[2], Vec3(9, 20, 30));
}

Vec3 normal_of(const TriangleMesh& mesh) {
  const IndexedTriangle t = mesh.triangles()[0];
  const auto p = mesh.positions();
  return glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

TEST_F(SceneTest, MirroringTurnsTheWinding) {
  EXPECT_GT(normal_of(object(Json::object()).mesh).z, 0);
  // Mirrored in x, the front is still the front: the normal is mirrored, which leaves z.
  EXPECT_GT(normal_of(object({{"scale", {-1, 1, 1}}}).mesh).z, 0);
  EXPECT_GT(normal_of(object({{"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}).mesh).z, 0);
  EXPECT_LT(normal_of(object({{"scale", -1}}).mesh).z, 0);  // mirrored in z too
  EXPECT_LT(normal_of(object({{"rotation", {1, 0, 0, 0}}}).mesh).z, 0);
}

TEST_F(SceneTest, QuaternionIsNormalisedWithAWarning) {
  Json document = good();
  document["objects"][0]["rotation"] = {0, 0, 0, 2};
  const LoadedScene loaded = parse(document);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("/objects/0/rotation"), std::string::npos) << loaded.warnings[0];
  EXPECT_EQ(loaded.scene.objects[0].mesh.positions()[1], Vec3(1, 0, 0));
  document["objects"][0]["rotation"] = {0, 0, 1e-8, 1};
  EXPECT_TRUE(parse(document).warnings.empty());
}

TEST_F(SceneTest, UnknownKeysWarnAndStrictRefuses) {
  Json document = good();
  document["objects"].push_back({{"mesh", "t.off"}, {"colour", 1}, {"x-note", {{"deep", true}}}});
  document["lights"][0]["power/4"] = 1;
  const LoadedScene loaded = parse(document);
  ASSERT_EQ(loaded.warnings.size(), 2u);
  EXPECT_NE(loaded.warnings[0].find("/lights/0/power~14"), std::string::npos) << loaded.warnings[0];
  EXPECT_NE(loaded.warnings[1].find("/objects/1/colour"), std::string::npos) << loaded.warnings[1];
  EXPECT_EQ(Json::parse(loaded.scene.document)["objects"][1]["x-note"]["deep"], true);
  EXPECT_NE(message_of(document, true).find("/lights/0/power~14"), std::string::npos);
}

TEST_F(SceneTest, NumbersThatAreNotFiniteAreRefused) {
  // What writers of JSON make of NaN and infinity; too large a number names itself, the others their place.
  const std::string text = good().dump(), center = "[0,4,0]";
  for (const auto& [bad, named] : {std::pair("null", "/lights/0/center/1"),
                                   {"\"nan\"", "/lights/0/center/1"},
                                   {"1e999", "1e999"},
                                   {"-1e999", "1e999"},
                                   {"NaN", "s.json"},
                                   {"Infinity", "s.json"}}) {
    std::string changed = text;
    changed.replace(changed.find(center), center.size(), "[0," + std::string(bad) + ",0]");
    const std::string message = message_of_text(changed);
    EXPECT_NE(message, "no SceneError") << bad;
    EXPECT_NE(message.find(named), std::string::npos) << message;
  }
}

TEST_F(SceneTest, MeshMayBeShared) {
  Json document = good();
  document["objects"] = {{{"mesh", "t.off"}}, {{"mesh", "meshes/../t.off"}, {"translation", {5, 0, 0}}}};
  const Scene scene = parse(document).scene;
  EXPECT_EQ(scene.objects[0].mesh.positions()[1], Vec3(1, 0, 0));
  EXPECT_EQ(scene.objects[1].mesh.positions()[1], Vec3(6, 0, 0));
  EXPECT_EQ(scene.bounds().high, Vec3(6, 1, 1));
}

TEST_F(SceneTest, BoundsOfCastersLeaveOthersOut) {
  Json document = good();
  document["objects"].push_back({{"mesh", "t.off"}, {"scale", 10}, {"casts", false}});
  const Scene scene = parse(document).scene;
  EXPECT_EQ(scene.bounds().high, Vec3(10));
  EXPECT_EQ(scene.caster_bounds().high, Vec3(1));
}

TEST_F(SceneTest, BadMeshesNameTheirKey) {
  Json document = good();
  document["objects"][0]["mesh"] = "missing.off";
  try {
    parse(document);
    FAIL();
  } catch (const MeshError& e) {
    EXPECT_NE(std::string(e.what()).find("/objects/0/mesh"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("missing.off"), std::string::npos) << e.what();
  }
  write("degenerate.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1 1\n");
  document["objects"][0]["mesh"] = "degenerate.off";
  EXPECT_THROW(parse(document), MeshError);
}

TEST_F(SceneTest, FacesLeftOutAreWarnedAbout) {
  write("partly.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 1\n");
  Json document = good();
  document["objects"][0]["mesh"] = "partly.off";
  const LoadedScene loaded = parse(document);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("left out 1 face "), std::string::npos) << loaded.warnings[0];
}

TEST_F(SceneTest, SceneWithoutACameraGetsOneThatLooksAtIt) {
  Json document = good();
  document.erase("camera");
  const Scene scene = parse(document).scene;
  const Vec3 sight = glm::normalize(scene.camera.target - scene.camera.eye);
  const Vec3 to_center = glm::normalize(scene.bounds().center() - scene.camera.eye);
  EXPECT_GT(glm::dot(sight, to_center), 0.98);
}

TEST_F(SceneTest, ScenesOfTheRepositoryLoadStrictly) {
  for (const auto& entry : fs::directory_iterator(PENUMBRA_DATA "/scenes")) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".json" || !stem.ends_with("-medium")) continue;
    const LoadedScene loaded = load_scene(entry.path(), {.strict = true});
    EXPECT_EQ(loaded.scene.objects.size(), 2u) << entry.path();
    EXPECT_FALSE(loaded.scene.caster_bounds().empty()) << entry.path();
  }
}

TEST_F(SceneTest, FilesThatAreNoScenesAreRefused) {
  EXPECT_THROW(load_scene(folder_ / "missing.json"), SceneError);
  fs::create_directory(folder_ / "folder.json");
  EXPECT_THROW(load_scene(folder_ / "folder.json"), SceneError);
  EXPECT_THROW(load_scene(write("latin1.json", "{\"x-\xe4\":1}")), SceneError);
  EXPECT_THROW(load_scene(write("large.json", std::string((16u << 20) + 1, ' '))), SceneError);
  EXPECT_THROW(load_scene(write("deep.json", "{\"version\":1,\"x-deep\":" + std::string(100, '[') +
                                                 std::string(100, ']') + "}")),
               SceneError);
}

}  // namespace
}  // namespace penumbra
