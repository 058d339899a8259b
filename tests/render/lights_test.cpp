// Several lights: each sees what it sees alone, and their light adds up.
#include <gtest/gtest.h>

#include "penumbra/mesh/error.h"
#include "penumbra/render/renderer.h"
#include "tests/render/draft_options.h"
#include "tests/render/render_support.h"

namespace penumbra {
namespace {

RenderOptions by(const std::string& method) {
  RenderOptions options;
  options.method = method;
  options.width = 120;
  options.height = 90;
  options.options = {{"dbuffer-size", std::uint64_t{256}}, {"texture-size", std::uint64_t{128}}};
  options.options.merge(testing::drafts_of(method));
  return options;
}

/// The scene's own light and a red one at its side.
Scene scene_of_two() {
  Scene scene = testing::data_scene("torus-medium");
  scene.lights[0].name = "key";
  Light fill = scene.lights[0];
  fill.name = "fill-2";
  DiskLight& disk = std::get<DiskLight>(fill.shape);
  disk.center += Vec3(1.5, -0.5, 0.7);
  disk.radius *= 0.5;
  fill.radiance = {8, 1, 0.5};
  scene.lights.push_back(fill);
  return scene;
}

Scene with_light(const Scene& scene, std::size_t k) {
  Scene out = scene;
  out.lights = {scene.lights[k]};
  return out;
}

/// Each light's channels are those of a picture under it alone, RGB is the sum of theirs.
void expect_sum(const Scene& scene, const RenderOptions& options) {
  const Image image = render(scene, options).image;
  std::vector<Image> single;
  for (std::size_t k = 0; k < scene.lights.size(); ++k)
    single.push_back(render(with_light(scene, k), options).image);
  for (std::size_t k = 0; k < scene.lights.size(); ++k) {
    const std::string &name = scene.lights[k].name, what = options.method + ", " + name;
    EXPECT_EQ(image.at("visibility." + name), single[k].at("visibility")) << what;
    EXPECT_EQ(image.at("region." + name), single[k].at("region")) << what;
    EXPECT_EQ(image.at("object"), single[k].at("object")) << what;
  }
  for (const char* channel : {"R", "G", "B"}) {
    double brightest = 0.0;
    for (std::size_t i = 0; i < image.at(channel).size(); ++i) {
      double sum = 0.0;
      for (const Image& one : single) sum += one.at(channel)[i];
      // Each picture rounds to float, and so does the sum.
      ASSERT_NEAR(image.at(channel)[i], sum, 2e-7 * sum)
          << options.method << ", " << channel << ", pixel " << i;
      brightest = std::max(brightest, sum);
    }
    EXPECT_GT(brightest, 0.05) << channel;
  }
  EXPECT_EQ(image.channels.count("visibility"), 0u) << "which light's?";
}

TEST(Lights, AddUpByEveryMethod) {
  register_drawing_methods();
  for (const MethodInfo& method : methods()) expect_sum(scene_of_two(), by(method.name));
}

TEST(Lights, OfBothShapesAddUp) {
  Scene scene = scene_of_two();
  scene.lights[1].shape = RectangleLight{
      .center = {1.5, 4, 0.5}, .normal = {-0.2, -1, 0}, .tangent = {1, 0, 1}, .half_extents = {0.6, 0.2}};
  expect_sum(scene, by("reference"));
  expect_sum(scene, by("occlusion-textures"));
  EXPECT_THROW(render(scene, by("silhouette")), UsageError) << "one of them is no disk";
}

TEST(Lights, OfOneSceneDoNotShareTheirShadows) {
  const RenderResult r = render(scene_of_two(), by("silhouette"));
  ASSERT_EQ(r.lights.size(), 2u);
  EXPECT_EQ(r.lights[0].light, "key");
  EXPECT_EQ(r.lights[1].light, "fill-2");
  EXPECT_NE(r.lights[0].visibility, r.lights[1].visibility);
  EXPECT_EQ(r.lights[0].visibility, r.image.at("visibility.key"));
  EXPECT_EQ(r.lights[1].visibility, r.image.at("visibility.fill-2"));
}

// What is kept a light is kept for eight of them; more are right too, and so is the picture after them.
TEST(Lights, MayBeMoreThanAreKept) {
  Scene scene = testing::data_scene("cube-medium");
  const Light first = scene.lights[0];
  scene.lights.clear();
  for (int k = 0; k < 10; ++k) {
    Light light = first;
    light.name = "l" + std::to_string(k);
    std::get<DiskLight>(light.shape).center += Vec3(0.1 * k, 0.05 * k, -0.1 * k);
    scene.lights.push_back(light);
  }
  for (const char* method : {"silhouette", "dbuffer", "occlusion-textures"}) {
    RenderOptions options = by(method);
    options.width = 64, options.height = 48;
    Renderer renderer(scene);
    for (int frame = 0; frame < 3; ++frame) {
      const Image image = renderer.render(options).image;
      for (std::size_t k = 0; k < scene.lights.size(); ++k)
        EXPECT_EQ(image.at("visibility." + scene.lights[k].name),
                  render(with_light(scene, k), options).image.at("visibility"))
            << method << ", picture " << frame << ", light " << k;
    }
  }
}

TEST(Lights, OneOfThemMayMove) {
  Scene scene = scene_of_two();
  for (const char* method : {"silhouette", "dbuffer", "reference"}) {
    Renderer renderer(scene);
    renderer.render(by(method));
    Scene moved = scene;
    std::get<DiskLight>(moved.lights[1].shape).center.x -= 0.5;
    renderer.set_light(1, moved.lights[1]);
    EXPECT_EQ(renderer.render(by(method)).image.channels, render(moved, by(method)).image.channels) << method;
  }
}

constexpr const char* kDisk = R"({"shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":0.5)";

Scene parsed(const std::vector<std::string>& names) {
  std::string lights;
  for (const std::string& name : names)
    lights += (lights.empty() ? "" : ",") + std::string(kDisk) +
              (name.empty() ? "}" : ",\"name\":\"" + name + "\"}");
  return parse_scene(R"({"version":1,"lights":[)" + lights +
                         R"(],"camera":{"eye":[3,3,5],"target":[0,0,0]},"objects":[{"mesh":"cube.off"}]})",
                     std::filesystem::path(PENUMBRA_DATA) / "scenes", "s.json")
      .scene;
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const Light& light : scene.lights) names.push_back(light.name);
  return names;
}

TEST(Lights, HaveNames) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names_of(parsed({""})), Names{""}) << "one needs none";
  EXPECT_EQ(names_of(parsed({"key"})), Names{"key"});
  EXPECT_EQ(names_of(parsed({"", "", "key"})), (Names{"light0", "light1", "key"}));
  EXPECT_EQ(render(parsed({"key"}), by("hard")).image.channels.count("visibility"), 1u) << "one light alone";
}

TEST(Lights, OfTheSameNameAreRefused) {
  for (const auto& names :
       std::vector<std::vector<std::string>>{{"key", "key"}, {"light1", ""}, {"a", "b", "a"}})
    try {
      parsed(names);
      ADD_FAILURE() << names.back();
    } catch (const SceneError& e) {
      EXPECT_NE(std::string(e.what()).find("\"" + (names.back().empty() ? "light1" : names.back()) + "\""),
                std::string::npos)
          << e.what();
    }
  for (const char* name : {"a b", "a.b", "ü", "a/b"}) EXPECT_THROW(parsed({name, "b"}), SceneError) << name;
}

TEST(Lights, AreFoundByNameAndByNumber) {
  const Scene scene = parsed({"", "key", "2"});
  EXPECT_EQ(scene.light_index("light0"), 0u);
  EXPECT_EQ(scene.light_index("key"), 1u);
  EXPECT_EQ(scene.light_index("0"), 0u);
  EXPECT_EQ(scene.light_index("1"), 1u);
  EXPECT_EQ(scene.light_index("2"), 2u);
  for (const char* text : {"", "Key", "3", "-1", "1.0", "0x0", " 1"}) {
    try {
      scene.light_index(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find("0 (light0), 1 (key), 2 (2)"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace penumbra
