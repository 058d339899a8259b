// glTF files as scenes: places, colors, normals, lights and cameras against tests/data/gltf/make.py, which
// computes them by itself (judge.mjs there compares three.js with it); what is refused; random damage.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "mesh/io/read_file.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"
#include "penumbra/volumes/shadow_mesh.h"
#include "render/scene/gltf/gltf_scene.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const fs::path kFolder = fs::path(PENUMBRA_SOURCE) / "tests/data/gltf";

Vec3 vec3(const Json& numbers) {
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}
bool is_near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) <= 2e-6 * (1.0 + glm::length(b));  // files hold single precision
}

/// What the file's maker says under this key, if anything.
void expect_near(const Vec3& v, const Json& expected, const char* key) {
  if (!expected.contains(key)) return;
  EXPECT_TRUE(is_near(v, vec3(expected[key]))) << key << ": " << v.x << " " << v.y << " " << v.z;
}

constexpr std::size_t kNowhere = 3;

/// Which corner of b the first of a is, where all are the same in the same order.
std::size_t turn_between(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (is_near(a[0], b[k]) && is_near(a[1], b[(k + 1) % 3]) && is_near(a[2], b[(k + 2) % 3])) return k;
  return kNowhere;
}
bool is_same(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  return turn_between(a, b) != kNowhere;
}

void expect_face(const SceneObject& object, std::uint32_t f, const Json& expected) {
  const TriangleMesh& mesh = object.mesh;
  const IndexedTriangle& t = mesh.triangles()[f];
  const std::uint32_t source = mesh.source_triangles()[f];
  const Json& e = expected["triangles"][source];
  const std::size_t turn =
      turn_between({mesh.positions()[t[0]], mesh.positions()[t[1]], mesh.positions()[t[2]]},
                   {Vec3(e[0], e[1], e[2]), Vec3(e[3], e[4], e[5]), Vec3(e[6], e[7], e[8])});
  ASSERT_NE(turn, kNowhere) << object.name << " triangle " << f;
  if (expected.contains("colors") && !expected["colors"][source].is_null()) {
    EXPECT_TRUE(is_near(object.albedo_of(f), vec3(expected["colors"][source]))) << object.name << f;
  }
  if (!expected.contains("normals")) return;
  ASSERT_EQ(object.corner_normals.size(), mesh.triangles().size());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_TRUE(is_near(Vec3(object.corner_normals[f][k]), vec3(expected["normals"][source][(k + turn) % 3])))
        << object.name << " triangle " << f << " corner " << k;
}

void expect_object(const SceneObject& object, const Json& expected) {
  EXPECT_EQ(object.name, expected.at("name"));
  expect_near(object.albedo, expected, "albedo");
  ASSERT_EQ(object.mesh.triangles().size(), expected.at("triangles").size());
  for (std::uint32_t f = 0; f < object.mesh.triangles().size(); ++f) expect_face(object, f, expected);
}

void expect_light(const Light& light, const Json& expected) {
  EXPECT_EQ(light.name, expected.at("name"));
  expect_near(light.radiance, expected, "radiance");
  if (expected.contains("direction")) {
    const auto& sun = std::get<DistantLight>(light.shape);
    EXPECT_TRUE(is_near(sun.direction, vec3(expected["direction"])));
    EXPECT_EQ(sun.angle_degrees, expected.at("angle_degrees"));
    const double sine = std::sin(0.5 * sun.angle_degrees * std::numbers::pi / 180.0);
    expect_near(light.radiance * (std::numbers::pi * sine * sine), expected, "irradiance");
    return;
  }
  if (expected.contains("half_extents")) {
    const auto& panel = std::get<RectangleLight>(light.shape);
    EXPECT_TRUE(is_near(panel.center, vec3(expected["center"])));
    expect_near(panel.normal, expected, "normal");
    expect_near(glm::normalize(panel.tangent), expected, "tangent");
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(panel.half_extents[k], double{expected["half_extents"][k]}, 1e-6);
    return;
  }
  const auto& disk = std::get<DiskLight>(light.shape);
  EXPECT_TRUE(is_near(disk.center, vec3(expected.at("center"))));
  expect_near(disk.normal, expected, "normal");
  EXPECT_NEAR(disk.radius, double{expected.at("radius")}, 1e-6);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

/// All below the folder, from there.
std::vector<std::string> gltf_files() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(kFolder))
    if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
      names.push_back(fs::relative(entry.path(), kFolder).generic_string());
  std::ranges::sort(names);
  return names;
}

Json expected_of(const fs::path& path) {
  std::ifstream in(fs::path(path).replace_extension(".expected.json"));
  return Json::parse(in);
}

void expect_lights_and_camera(const Scene& scene, const Json& expected) {
  ASSERT_FALSE(scene.lights.empty());
  if (expected.contains("lights")) {
    ASSERT_EQ(scene.lights.size(), expected["lights"].size());
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
      expect_light(scene.lights[i], expected["lights"][i]);
  }
  if (!expected.contains("camera")) return;
  const Json& camera = expected["camera"];
  EXPECT_TRUE(is_near(scene.camera.eye, vec3(camera["eye"])));
  EXPECT_TRUE(is_near(glm::normalize(scene.camera.target - scene.camera.eye), vec3(camera["towards"])));
  EXPECT_NEAR(scene.camera.fov_y_degrees, camera["fov_y_degrees"], 1e-9);
}

void expect_refused(const fs::path& path, const std::string& why) {
  try {
    load_scene(path);
    ADD_FAILURE() << path << " was read";
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
  }
}

class GltfFiles : public ::testing::TestWithParam<std::string> {};

TEST_P(GltfFiles, AreWhatTheirMakerSays) {
  const fs::path path = kFolder / GetParam();
  const Json expected = expected_of(path);
  if (expected.contains("refused")) return expect_refused(path, expected["refused"]);
  const auto [scene, warnings] = load_scene(path);
  ASSERT_EQ(scene.objects.size(), expected.at("objects").size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    expect_object(scene.objects[i], expected["objects"][i]);
  for (const Json& what : expected.value("ignored", Json::array()))
    EXPECT_NE(joined(warnings).find(what.get<std::string>()), std::string::npos) << what << joined(warnings);
  EXPECT_EQ(scene.files.front(), path);
  expect_lights_and_camera(scene, expected);
}

INSTANTIATE_TEST_SUITE_P(Data, GltfFiles, ::testing::ValuesIn(gltf_files()));

TEST(Gltf, TheFolderHasItsFiles) {
  EXPECT_EQ(gltf_files().size(), 24u);
}

TEST(Gltf, InstancesInOnePlaceShareTheirMesh) {
  const Scene scene = load_scene(kFolder / "common/instances.glb").scene;
  EXPECT_EQ(scene.objects[3].mesh.positions().data(), scene.objects[4].mesh.positions().data());
  EXPECT_NE(scene.objects[0].mesh.positions().data(), scene.objects[1].mesh.positions().data());
}

TEST(Gltf, OptionsSayTheSizesOfLights) {
  const auto [scene, warnings] =
      load_scene(kFolder / "common/nodes.gltf", {.strict = false, .light_radius = 0.75, .sun_angle = 1.5});
  EXPECT_EQ(std::get<DistantLight>(scene.lights[0].shape).angle_degrees, 1.5);
  EXPECT_EQ(std::get<DiskLight>(scene.lights[1].shape).radius, 0.75);
  EXPECT_EQ(joined(warnings).find("no size"), std::string::npos);
  EXPECT_NE(joined(load_scene(kFolder / "common/strips.glb").warnings).find("no lights"), std::string::npos);
  EXPECT_THROW(load_scene(kFolder / "common/nodes.gltf", {.strict = true}), SceneError);
}

TEST(Gltf, FromMemoryABinaryFileIsRecognized) {
  const std::vector<std::byte> bytes = detail::read_bytes(kFolder / "common/strips.glb");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_EQ(parse_scene_or_mesh(text, "", "standard input").scene.objects.size(), 1u);
}

TEST(Gltf, VolumesAreWrittenAndReadBack) {
  ShadowMesh written;
  written.positions = {{1000, 0, 0}, {1001, 0, 0}, {1000, 1, 0}, {1000, 0, 1.25},
                       {-5, 2, 7},   {-4, 2, 7},   {-5, 3, 7}};
  written.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {4, 5, 6}};
  written.guarantee = Guarantee::kCertified;
  for (std::uint32_t i = 0; i < 5; ++i) written.tags.push_back({ShadowKind::kSolid, 0, i < 4 ? 2u : 5u});
  const fs::path path = fs::path(::testing::TempDir()) / "penumbra-gltf-test.glb";
  write_shadow_mesh(path, written);
  const Scene scene = load_scene(path).scene;
  write_shadow_mesh(path, {});
  EXPECT_THROW(load_scene(path), SceneError);  // "has no triangles": it was read
  fs::remove(path);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "object 2");
  EXPECT_EQ(scene.objects[1].name, "object 5");
  std::size_t i = 0;
  for (const SceneObject& object : scene.objects)
    for (const IndexedTriangle& t : object.mesh.triangles()) {
      const IndexedTriangle& w = written.triangles[i++];
      const auto p = object.mesh.positions();
      EXPECT_TRUE(is_same({p[t[0]], p[t[1]], p[t[2]]},
                          {written.positions[w[0]], written.positions[w[1]], written.positions[w[2]]}));
    }
  EXPECT_EQ(i, written.triangles.size());
}

std::string complaint_of(const Json& document) {
  const std::string text = document.dump();
  try {
    detail::read_gltf(std::as_bytes(std::span(text)), "", "f.gltf", {});
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

Json nodes_file() {
  std::ifstream in(kFolder / "common/nodes.gltf");
  return Json::parse(in);
}

/// `change` says where, by a JSON pointer, and what is put there.
struct Damage {
  const char* where;
  Json what;
  const char* says;
};

TEST(Gltf, ComplaintsSayWhatWhereAndWhatToDo) {
  ASSERT_EQ(complaint_of(nodes_file()), "");
  const std::string cycle = "two parents, or is its own ancestor";
  for (const Damage& damage : std::vector<Damage>{
           {"/extensionsRequired", {"KHR_draco_mesh_compression"}, "compressed by Draco"},
           {"/extensionsRequired", {"EXT_meshopt_compression"}, "compressed by meshopt"},
           {"/extensionsRequired", {"VENDOR_holograms"}, "VENDOR_holograms"},
           {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression", Json::object(),
            "compressed by Draco"},
           {"/asset", nullptr, "asset"},
           {"/nodes/1/children", {0}, cycle.c_str()},
           {"/nodes/1/children", {1}, cycle.c_str()},
           {"/nodes/1/children", {99}, "nodes[99]: does not exist"},
           {"/nodes/1/mesh", 7, "a mesh that does not exist"},
           {"/scene", 3, "scene: does not exist"},
           {"/accessors/0/count", 1000000, "bufferViews[0]"},
           {"/accessors/0/count", 3, "there are 3"},
           {"/accessors/0/type", "VEC4", "3 numbers an element"},
           {"/accessors/0/bufferView", 9, "bufferViews[9]: does not exist"},
           {"/bufferViews/0/byteOffset", 1u << 30, "leaves its buffer"},
           {"/bufferViews/0/byteStride", 4, "overlap"},
           {"/buffers/0/uri", "none.bin", "none.bin"},
           {"/nodes/2/mesh", -1, ""},
           {"/meshes/0/primitives/0/mode", 9, "mode 9"},
           {"/meshes/0/primitives/0/mode", 1, "no triangles"},
           {"/meshes/0/primitives/0/material", 5, "a material that does not exist"},
           {"/nodes/4/extensions/KHR_lights_punctual/light", 8, "a light that does not exist"},
           {"/extensions/KHR_lights_punctual/lights/1/extras/radius", -1.0, "radius of -1"},
           {"/extensions/KHR_lights_punctual/lights/0/extras/angle_degrees", 180.0, "180 degrees"},
           {"/extensions/KHR_lights_punctual/lights/1/extras/radius", 1e-170, "is so small"},
           {"/nodes/5/translation", {0, 1e200, 0}, "light"},
           {"/nodes/0/translation", {1e300, 0, 0}, "unit of length"}}) {
    Json document = nodes_file();
    const Json::json_pointer where(damage.where);
    if (damage.what.is_null())
      document.erase(where.back());
    else
      document[where] = damage.what;
    const std::string said = complaint_of(document);
    EXPECT_NE(said.find(damage.says), std::string::npos) << damage.where << ": " << said;
    if (*damage.says) {
      EXPECT_NE(said.find("; "), std::string::npos) << said;
      EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
    }
  }
}

TEST(Gltf, DeepAndCutFilesAreRefused) {
  const std::string deep =
      R"({"asset":{"version":"2.0"},"extras":)" + std::string(5000, '[') + std::string(5000, ']') + "}";
  EXPECT_THROW(detail::read_gltf(std::as_bytes(std::span(deep)), "", "f", {}), SceneError);
  const std::vector<std::byte> bytes = detail::read_bytes(kFolder / "common/instances.glb");
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    EXPECT_THROW(detail::read_gltf(std::span(bytes).first(length), "", "f", {}), Error) << length;
}

/// Bytes changed, cut out and doubled at random: a scene comes of it, or an error; nothing else.
TEST(Gltf, DamagedFilesNeverCrash) {
  const unsigned seed = 20261130;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::size_t scenes = 0, refused = 0;
  for (const std::string& name : gltf_files()) {
    const std::vector<std::byte> whole = detail::read_bytes(kFolder / name);
    for (int run = 0; run < 100; ++run) {
      std::vector<std::byte> bytes = whole;
      for (unsigned k = 1 + random() % 4; k-- > 0;) {
        const auto at = static_cast<std::ptrdiff_t>(random() % bytes.size());
        switch (random() % 4) {
          case 0:
            bytes[static_cast<std::size_t>(at)] = static_cast<std::byte>(random());
            break;
          case 1:
            bytes[static_cast<std::size_t>(at)] = static_cast<std::byte>("0123456789-\"{}[],"[random() % 17]);
            break;
          case 2:
            bytes.erase(bytes.begin() + at);
            break;
          default:
            bytes.insert(bytes.begin() + at, bytes[random() % bytes.size()]);
        }
      }
      try {
        const LoadedScene loaded = detail::read_gltf(bytes, (kFolder / name).parent_path(), name, {});
        EXPECT_FALSE(loaded.scene.objects.empty());
        ++scenes;
      } catch (const SceneError&) {
        ++refused;
      } catch (const MeshError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(scenes, 100u);
  EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace penumbra
