// How a picture looks: options, what a bare mesh gets, and that nothing measured changes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "penumbra/render/image/image.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Strings = std::vector<std::string>;

class PictureOptionsTest : public ProgramTest {
 protected:
  PictureOptionsTest() {
    mesh_ = write("t.off", kTetrahedron);
    write("floor.off", "OFF\n4 2 0\n-3 0 -3\n-3 0 3\n3 0 3\n3 0 -3\n3 0 1 2\n3 0 2 3\n");
    scene_ = write("scene.json", scene_text("t.off", R"(},{"mesh":"floor.off","casts":false)"));
  }
  Outcome draw(const std::string& scene, const std::string& name, const Strings& more) const {
    Strings words = {"render", scene, "--size", "32x24", "--output", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  Image drawn(const std::string& scene, const Strings& more) const {
    EXPECT_EQ(draw(scene, "drawn.exr", more).err, "");
    return read_exr(file("drawn.exr"));
  }

  std::string mesh_, scene_;
};

TEST_F(PictureOptionsTest, ChangeNothingThatIsMeasured) {
  for (const std::string& scene : {scene_, mesh_}) {
    const Image plain = drawn(scene, {"--antialias", "1", "--ambient", "0"});
    for (const Strings& more :
         {Strings{}, Strings{"--antialias", "3"}, Strings{"--ambient", "0.2"}, Strings{"--shadow-catcher"},
          Strings{"--antialias", "2", "--ambient", "1", "--shadow-catcher"},
          Strings{"--show-umbra", mesh_, "--show-penumbra", mesh_, "--show-lights"}}) {
      const Image image = drawn(scene, more);
      ASSERT_EQ(image.channels.size(), plain.channels.size());
      for (const auto& [name, values] : plain.channels)
        if (name.size() > 1) {
          EXPECT_EQ(image.at(name), values) << name;
        }
    }
  }
}

TEST_F(PictureOptionsTest, ShowSolidsAsGlass) {
  ASSERT_EQ(run({"volumes", scene_, "--umbra", path("u.ply"), "--penumbra", path("p.ply")}).code, 0);
  const Image plain = drawn(scene_, {});
  const Image umbra = drawn(scene_, {"--show-umbra", path("u.ply")});
  const Image both = drawn(scene_, {"--show-umbra", path("u.ply"), "--show-penumbra", path("p.ply")});
  EXPECT_NE(umbra.channels, plain.channels);
  EXPECT_NE(both.channels, umbra.channels);
  const Outcome missing = draw(scene_, "x.png", {"--show-umbra", path("none.ply")});
  EXPECT_EQ(missing.code, 3);
  EXPECT_NE(missing.err.find("none.ply"), std::string::npos);
}

TEST_F(PictureOptionsTest, AreNotUsedByScenesThatDoNotAsk) {
  EXPECT_EQ(drawn(scene_, {}).channels, drawn(scene_, {"--antialias", "1", "--ambient", "0"}).channels);
  EXPECT_NE(drawn(mesh_, {}).channels, drawn(mesh_, {"--antialias", "1"}).channels);
  EXPECT_NE(drawn(mesh_, {}).channels, drawn(mesh_, {"--ambient", "0"}).channels);
}

// In umbra a floor has nothing but fill light: albedo 0.8 under a sky of 0.5.
TEST_F(PictureOptionsTest, AmbientFillsTheUmbra) {
  const Image image = drawn(scene_, {"--ambient", "0.5"});
  int umbra = 0;
  for (std::size_t i = 0; i < image.at("R").size(); ++i) {
    if (image.at("object")[i] != 1.0f || image.at("visibility")[i] != 0.0f) continue;
    EXPECT_NEAR(image.at("R")[i], 0.4, 1e-6);
    ++umbra;
  }
  EXPECT_GT(umbra, 0);
}

TEST_F(PictureOptionsTest, ShadowCatchersAreTheShadowAlone) {
  const Image image = drawn(scene_, {"--shadow-catcher"});
  int floor = 0;
  for (std::size_t i = 0; i < image.at("R").size(); ++i) {
    if (image.at("object")[i] == 0.0f) {
      EXPECT_EQ(image.at("A")[i], 1.0f);
    }
    if (image.at("object")[i] != 1.0f) continue;
    EXPECT_FLOAT_EQ(image.at("A")[i], 1.0f - image.at("visibility")[i])
        << "the floor sees all of the light else";
    EXPECT_EQ(image.at("G")[i], 0.0f);
    ++floor;
  }
  EXPECT_GT(floor, 100);
  EXPECT_NE(
      draw(write("all.json", scene_text("t.off")), "a.exr", {"--shadow-catcher"}).err.find("has no effect"),
      std::string::npos);
}

TEST_F(PictureOptionsTest, BackgroundsAreForPngs) {
  EXPECT_EQ(draw(scene_, "a.png", {"--background", "transparent"}).err, "");
  EXPECT_EQ(draw(scene_, "b.png", {}).err, "");
  EXPECT_EQ(draw(scene_, "c.png", {"--background", "#e6e6e6"}).err, "");
  constexpr std::size_t kColorType = 25;
  EXPECT_EQ(read_text(file("a.png"))[kColorType], 6);
  EXPECT_EQ(read_text(file("b.png"))[kColorType], 2);
  EXPECT_EQ(read_text(file("b.png")), read_text(file("c.png")));
  const Outcome outcome = draw(scene_, "a.exr", {"--background", "white"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.error_lines(), 1u);
  EXPECT_NE(outcome.err.find("--background has no effect"), std::string::npos) << outcome.err;
}

TEST_F(PictureOptionsTest, OfASceneFileAreTaken) {
  nlohmann::json document = nlohmann::json::parse(read_text(scene_));
  document["ambient"] = 0.5;
  document["antialias"] = 2;
  document["background"] = "transparent";
  const std::string asks = write("asks.json", document.dump());
  EXPECT_EQ(drawn(asks, {}).channels, drawn(scene_, {"--ambient", "0.5", "--antialias", "2"}).channels);
  EXPECT_EQ(drawn(asks, {"--ambient", "0", "--antialias", "1"}).channels, drawn(scene_, {}).channels);
  draw(asks, "a.png", {});
  EXPECT_EQ(read_text(file("a.png"))[25], 6);
}

TEST_F(PictureOptionsTest, AreSaidByImagesAndStatistics) {
  EXPECT_EQ(drawn(scene_, {"--antialias", "3", "--ambient", "0.25"}).metadata.at("penumbraPicture"),
            R"({"ambient":[0.25,0.25,0.25],"antialias":3})");
  const Outcome outcome = run({"render", mesh_, "--size", "16x12", "--stats", "-"});
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("antialias"), 2);
}

TEST_F(PictureOptionsTest, ThatMakeNoSenseAreRefused) {
  for (const Strings& more :
       {Strings{"--antialias", "0"}, Strings{"--antialias", "17"}, Strings{"--antialias", "two"},
        Strings{"--ambient", "-1"}, Strings{"--ambient", "nan"}, Strings{"--background", "plaid"},
        Strings{"--background", "#12345"}}) {
    const Outcome outcome = draw(scene_, "a.png", more);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(more.front()), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace penumbra::test
