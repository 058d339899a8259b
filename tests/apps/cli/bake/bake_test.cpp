// penumbra bake: its files, parts that are there already, and what it refuses.
#include <gtest/gtest.h>

#include "apps/cli/bake/bake_parts.h"
#include "mesh/io/npy.h"
#include "penumbra/mesh/error.h"
#include "penumbra/mesh/io/polygon_soup.h"
#include "penumbra/render/image/image.h"
#include "penumbra/render/scene/scene.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

const std::string kCube = PENUMBRA_DATA "/scenes/cube-medium.json";
const std::string kRoom = PENUMBRA_DATA "/bake/room.json";

class BakeCommandTest : public ProgramTest {};

TEST_F(BakeCommandTest, WritesAMeshOrAnArray) {
  for (const char* to : {"faces", "vertices"}) {
    const Outcome mesh =
        run({"bake", kCube, "--object", "cube.off", "--to", to, "--output", path("lit.ply")});
    ASSERT_EQ(mesh.code, 0) << mesh.err;
    EXPECT_EQ(read_mesh(path("lit.ply")).triangles().size(), 12u);
    EXPECT_NE(read_text(path("lit.ply")).find("property float visibility\n"), std::string::npos);
    const Outcome array = run({"bake", kCube, "--object", "1", "--to", to, "--output", path("lit.npy")});
    ASSERT_EQ(array.code, 0) << array.err;
    EXPECT_NE(read_text(path("lit.npy")).find(to == std::string("faces") ? "(12,)" : "(8,)"),
              std::string::npos);
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"lit.npy", "lit.ply"})) << "no parts are left";
}

TEST_F(BakeCommandTest, OfSeveralLightsEachHasAColumn) {
  ASSERT_EQ(run({"bake", kRoom, "--object", "shelf.off", "--to", "faces", "--output", path("lit.ply")}).code,
            0);
  for (const char* name : {"visibility_ceiling", "visibility_panel", "visibility_spot"})
    EXPECT_NE(read_text(path("lit.ply")).find(name), std::string::npos) << name;
  ASSERT_EQ(run({"bake", kRoom, "--object", "4", "--to", "faces", "--light", "spot", "--light", "0",
                 "--output", path("two.npy")})
                .code,
            0);
  EXPECT_EQ(detail::read_npy_rows(path("two.npy")).columns, 2u);
  ASSERT_EQ(run({"bake", kRoom, "--object", "4", "--to", "vertices", "--quantity", "irradiance", "--output",
                 path("e.ply")})
                .code,
            0);
  EXPECT_NE(read_text(path("e.ply")).find("property float R\n"), std::string::npos);
}

TEST_F(BakeCommandTest, WritesAMapAMeshAndAPicture) {
  const Outcome baked = run({"bake", kRoom, "--lightmap", path("room.exr"), "--mesh", path("room.glb"),
                             "--texels", "96", "--picture", path("lit.exr"), "--size", "48x36"});
  ASSERT_EQ(baked.code, 0) << baked.err;
  EXPECT_NE(baked.out.find("charts in 96x96 texels"), std::string::npos) << baked.out;
  const Image map = read_exr(path("room.exr"));
  EXPECT_EQ(map.width, 96);
  for (const char* name : {"visibility.ceiling", "visibility.panel", "visibility.spot", "coverage"})
    EXPECT_TRUE(map.has(name)) << name;
  EXPECT_EQ(map.channels.size(), 4u);
  EXPECT_TRUE(map.metadata.contains("penumbraBake"));
  EXPECT_TRUE(read_exr(path("lit.exr")).has("R"));
  EXPECT_NE(read_text(path("room.glb")).find("TEXCOORD_1"), std::string::npos);
  // What was written is a scene again, with as many faces.
  const Scene scene = load_scene(path("room.glb")).scene;
  EXPECT_EQ(scene.objects.size(), 5u);
  EXPECT_EQ(scene.objects[0].mesh.triangles().size(), 10u);
}

TEST_F(BakeCommandTest, APictureByTheMapIsNearTheDirectOne) {
  const std::vector<std::string> size{"--size", "160x120"};
  ASSERT_EQ(run({"render", kRoom, "--output", path("direct.exr"), "--size", "160x120"}).code, 0);
  const Image direct = read_exr(path("direct.exr"));
  for (const char* quantity : {"visibility", "irradiance"}) {
    ASSERT_EQ(run({"bake", kRoom, "--lightmap", path("m.exr"), "--quantity", quantity, "--picture",
                   path("lit.exr"), "--size", "160x120"})
                  .code,
              0);
    const Image lit = read_exr(path("lit.exr"));
    double sum = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < lit.at("G").size(); ++i) {
      const double error = lit.at("G")[i] - direct.at("G")[i];
      sum += error * error;
      scale += direct.at("G")[i] * direct.at("G")[i];
    }
    EXPECT_LT(std::sqrt(sum / scale), 0.05) << quantity;
  }
}

TEST_F(BakeCommandTest, ARoomThatIsOneClosedMeshGetsLightOnTheBack) {
  write("box.off",
        "OFF\n8 6 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n4 0 1 2 3\n4 5 4 7 "
        "6\n4 4 0 "
        "3 7\n4 1 5 6 2\n4 3 2 6 7\n4 4 5 1 0\n");
  const std::string scene =
      write("box.json", R"({"version": 1, "lights": [{"shape": "disk", "center": [0, 0.9, 0],
      "normal": [0, -1, 0], "radius": 0.2}], "camera": {"eye": [0, 0, 0.9], "target": [0, 0, 0], "up": [0, 1, 0],
      "fov_y_degrees": 90}, "objects": [{"mesh": "box.off"}]})");
  const auto seen = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"bake", scene, "--lightmap", path("m.exr"), "--texels", "64"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).code, 0);
    const Image map = read_exr(path("m.exr"));
    double sum = 0.0;
    for (const float v : map.at("visibility")) sum += v;
    return sum;
  };
  EXPECT_EQ(seen({}), 0.0);
  EXPECT_GT(seen({"--back", "box.off"}), 1000.0);
}

TEST_F(BakeCommandTest, SaysWhatItCannotDo) {
  const auto complaint = [this](std::vector<std::string> words) {
    words.insert(words.begin(), {"bake", kRoom});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(complaint({}).find("--lightmap"), std::string::npos);
  EXPECT_NE(complaint({"--to", "faces"}).find("--output"), std::string::npos);
  EXPECT_NE(complaint({"--to", "faces", "--output", path("x.ply"), "--object", "cub"}).find("shelf.off"),
            std::string::npos);
  EXPECT_NE(complaint({"--lightmap", path("x.png")}).find(".exr"), std::string::npos);
  EXPECT_NE(complaint({"--lightmap", path("x.exr"), "--light", "sun"}).find("ceiling"), std::string::npos);
  EXPECT_NE(complaint({"--lightmap", path("x.exr"), "--texels", "32", "--padding", "8"}).find("no room"),
            std::string::npos);
  EXPECT_NE(complaint({"--lightmap", path("x.exr"), "--mesh", path("x.exr.glb"), "--to", "faces", "--output",
                       path("y.ply")})
                .find("--lightmap"),
            std::string::npos);
  EXPECT_TRUE(files().empty());
}

TEST_F(BakeCommandTest, SaysWhichOptionsHaveNoEffect) {
  const auto said = [this](std::vector<std::string> words) {
    words.insert(words.begin(), {"bake", kCube, "--object", "1"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
  };
  const std::string faces =
      said({"--to", "faces", "--output", path("a.ply"), "--texels", "64", "--dilation", "2"});
  for (const char* option : {"--texels", "--dilation"})
    EXPECT_NE(faces.find(option + std::string(" has no effect")), std::string::npos) << faces;
  const std::string map =
      said({"--lightmap", path("a.exr"), "--texels", "32", "--side", "2", "--size", "8x8"});
  for (const char* option : {"--side", "--size"})
    EXPECT_NE(map.find(option + std::string(" has no effect")), std::string::npos) << map;
  EXPECT_EQ(said({"--to", "faces", "--output", path("b.ply"), "--side", "2"}), "");
}

/// Parts that count how often they are baked, and fail from the n-th on.
struct Counted {
  int baked = 0, fails_at = 1000;

  apps::BakeParts parts() {
    return {.count = 6,
            .values = [](std::size_t part) { return part + 1; },
            .cost = [](std::size_t) { return 1.0; },
            .bake =
                [this](std::size_t part, const Progress&) {
                  if (++baked == fails_at) throw SystemError("the light went out");
                  return std::vector<float>(part + 1, static_cast<float>(part) * 0.1f);
                }};
  }
};

class BakePartsTest : public ProgramTest {};

TEST_F(BakePartsTest, WhatIsThereIsNotDoneAgain) {
  const nlohmann::json settings = {{"scene", "a"}};
  Counted first{.fails_at = 4};
  EXPECT_THROW(apps::bake_all(first.parts(), apps::PartStore(file("parts"), settings), nullptr, {}),
               SystemError);
  EXPECT_EQ(first.baked, 4);
  const apps::PartStore store(file("parts"), settings);
  Counted second;
  EXPECT_EQ(apps::bake_all(second.parts(), store, nullptr, {}), 3u);
  EXPECT_EQ(second.baked, 3);
  for (std::size_t part = 0; part < 6; ++part)
    EXPECT_EQ(store.read(part), std::vector<float>(part + 1, static_cast<float>(part) * 0.1f));
  // A file that was cut off is no part.
  std::filesystem::resize_file(file("parts/5.f32"), 8);
  Counted third;
  EXPECT_EQ(apps::bake_all(third.parts(), store, nullptr, {}), 5u);
  store.remove(6);
  EXPECT_TRUE(files().empty());
}

TEST_F(BakePartsTest, PartsOfOtherSettingsAreRefused) {
  apps::PartStore(file("parts"), {{"scene", "b"}});
  // Without parts there is nothing to mix.
  apps::PartStore(file("parts"), {{"scene", "a"}}).write(0, {1.0f});
  EXPECT_NO_THROW(apps::PartStore(file("parts"), {{"scene", "a"}}));
  EXPECT_THROW(apps::PartStore(file("parts"), {{"scene", "b"}}), UsageError);
  std::filesystem::create_directory(file("mine"));
  write("mine/letter.txt", "keep");
  EXPECT_THROW(apps::PartStore(file("mine"), {{"scene", "a"}}), UsageError);
  write("file", "no folder");
  EXPECT_THROW(apps::PartStore(file("file"), {{"scene", "a"}}), SystemError);
}

TEST_F(BakePartsTest, FilesOfOthersAreKept) {
  std::filesystem::create_directory(file("theirs"));
  write("theirs/settings.json", R"({"editor": 1})");
  EXPECT_THROW(apps::PartStore(file("theirs"), {{"scene", "a"}}), UsageError);
  EXPECT_EQ(read_text(file("theirs/settings.json")), R"({"editor": 1})");
}

TEST_F(BakePartsTest, WhatAKilledWriteLeftIsRemoved) {
  std::filesystem::create_directory(file("parts"));
  write("parts/.penumbra-12-3.tmp", "half");
  const apps::PartStore store(file("parts"), {{"scene", "a"}});
  store.write(0, {1.0f});
  store.remove(1);
  EXPECT_FALSE(std::filesystem::exists(file("parts")));
}

TEST_F(BakePartsTest, ProgressNeverFalls) {
  double last = 0.0;
  Counted counted;
  apps::bake_all(counted.parts(), apps::PartStore(file("parts"), {}), nullptr, [&last](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
    return true;
  });
  EXPECT_GT(last, 0.5);
}

}  // namespace
}  // namespace penumbra::test
