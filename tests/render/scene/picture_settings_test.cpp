// What scene files ask of pictures, and that they ask for nothing unless they say so.
#include "penumbra/render/scene/picture_settings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "penumbra/mesh/error.h"
#include "penumbra/render/scene/scene.h"

namespace penumbra {
namespace {

using Json = nlohmann::json;

const Json kNothing = Json::object();

LoadedScene scene_with(const Json& keys, const Json& object_keys = kNothing) {
  Json document = Json::parse(R"({"version":1,"objects":[{"mesh":"cube.off"}],
      "lights":[{"shape":"disk","center":[0,4,0],"normal":[0,-1,0],"radius":0.5}]})");
  document.update(keys);
  document["objects"][0].update(object_keys);
  return parse_scene(document.dump(), PENUMBRA_DATA "/scenes", "s.json", {.strict = true});
}

TEST(Background, IsAColorOrNothing) {
  EXPECT_EQ(parse_background("#0a80ff").srgb, (std::array<unsigned char, 3>{10, 128, 255}));
  EXPECT_EQ(parse_background("white").srgb, (std::array<unsigned char, 3>{255, 255, 255}));
  EXPECT_EQ(parse_background("black").srgb, (std::array<unsigned char, 3>{0, 0, 0}));
  EXPECT_TRUE(parse_background("transparent").transparent);
  EXPECT_FALSE(parse_background("#000000").transparent);
  for (const char* bad : {"", "#", "#12345", "#1234567", "#12345g", "#-12345", "#+12345", "123456", "red"})
    EXPECT_THROW(parse_background(bad), UsageError) << bad;
}

TEST(Background, IsReadBackFromItsText) {
  for (const char* text : {"#000000", "#0a80ff", "#e6e6e6", "transparent"})
    EXPECT_EQ(to_text(parse_background(text)), text);
  EXPECT_EQ(to_text(Background{}), "#e6e6e6");
}

TEST(PictureSettings, AreNothingWhereAFileDoesNotAsk) {
  const Scene scene = scene_with(kNothing).scene;
  EXPECT_EQ(scene.picture.ambient, Vec3(0.0));
  EXPECT_EQ(scene.picture.background, Background{});
  EXPECT_EQ(scene.picture.antialias, 1);
  EXPECT_FALSE(scene.objects[0].shadow_catcher);
  EXPECT_EQ(scene.objects[0].fade.to, 0.0);
}

TEST(PictureSettings, AreRead) {
  const Scene scene = scene_with({{"ambient", {0.1, 0.2, 0.3}}, {"background", "#ffffff"}, {"antialias", 4}},
                                 {{"shadow_catcher", true}, {"fade", {1, 2.5}}})
                          .scene;
  EXPECT_EQ(scene.picture.ambient, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.picture.background, parse_background("white"));
  EXPECT_EQ(scene.picture.antialias, 4);
  EXPECT_TRUE(scene.objects[0].shadow_catcher);
  EXPECT_EQ(scene.objects[0].fade.from, 1.0);
  EXPECT_EQ(scene.objects[0].fade.to, 2.5);
  EXPECT_EQ(scene_with({{"ambient", 0.5}}).scene.picture.ambient, Vec3(0.5));
}

TEST(PictureSettings, ThatMakeNoSenseAreRefusedByTheirKey) {
  for (const Json& keys : {Json{{"ambient", -1}}, Json{{"ambient", {0, 0, -1}}}, Json{{"ambient", "some"}},
                           Json{{"background", "plaid"}}, Json{{"background", 1}}, Json{{"antialias", 0}},
                           Json{{"antialias", 1.5}}, Json{{"antialias", 17}}}) {
    try {
      scene_with(keys);
      FAIL() << keys;
    } catch (const SceneError& e) {
      EXPECT_NE(std::string(e.what()).find("/" + keys.begin().key()), std::string::npos) << e.what();
    }
  }
  for (const Json& keys : {Json{{"fade", {2, 1}}}, Json{{"fade", {-1, 1}}}, Json{{"fade", {1, 1}}},
                           Json{{"fade", 1}}, Json{{"shadow_catcher", 1}}})
    EXPECT_THROW(scene_with(kNothing, keys), SceneError) << keys;
}

}  // namespace
}  // namespace penumbra
