// penumbra study --peers: what is made of other programs' pictures, and that one that is missing or fails
// does not lose the run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/cli/study/page/base64.h"
#include "apps/cli/study/peers/peer.h"
#include "penumbra/render/renderer.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Json = nlohmann::json;

Scene scene_named(const std::string& name) {
  return load_scene(std::filesystem::path(PENUMBRA_DATA) / "scenes" / (name + ".json")).scene;
}

// What is done with the pictures of peers gives our own method's visibility back, at the horizon too.
TEST(StudyPeers, ARatioOfPicturesIsVisibility) {
  const Scene scene = scene_named("torus-medium");
  const auto draw = [&](const char* method) {
    return render(scene, {.method = method, .width = 96, .height = 72});
  };
  const RenderResult seen = draw("silhouette"), lit = draw("none");
  const std::vector<float>& horizon = lit.lights.front().visibility;
  const std::vector<float> ratio = apps::visibility_of_ratio(seen.image.at("G"), lit.image.at("G"), horizon);
  std::size_t partly = 0, at_horizon = 0;
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    if (seen.image.at("A")[i] == 0.0f) continue;
    const float v = seen.lights.front().visibility[i];
    EXPECT_NEAR(ratio[i], v, 1e-5f) << i;
    partly += v > 0.1f && v < 0.9f;
    at_horizon += horizon[i] > 0.0f && horizon[i] < 1.0f;
  }
  EXPECT_GT(partly, 300u);
  EXPECT_GT(at_horizon, 10u);
}

TEST(StudyPeers, Base64GoesThereAndBack) {
  for (const std::string& bytes :
       {std::string(), std::string("a"), std::string("ab"), std::string("\0\xff~", 3)})
    EXPECT_EQ(apps::from_base64(apps::base64_of(bytes)), bytes);
  EXPECT_EQ(apps::base64_of("ab"), "YWI=");
  EXPECT_EQ(apps::from_base64("Y\nWI="), "ab");
}

struct Expected {
  const char* peer;
  const char* scene;
  std::uint64_t samples;
  double mean_difference;
};

/// As `./run study --peers` installs it, or what PENUMBRA_THREE says.
std::filesystem::path three() {
  if (const char* given = std::getenv("PENUMBRA_THREE")) return given;
  return std::filesystem::path(PENUMBRA_DATA) / "../build/peers/node_modules/three";
}

class StudyPeer : public testing::TestWithParam<Expected> {};

// Another program agrees with our own method but for its noise, and what is not comparable in it.
TEST_P(StudyPeer, AgreesWhereItIsInstalled) {
  const std::vector<apps::Peer> all = apps::all_peers(three());
  const auto peer = std::ranges::find(all, GetParam().peer, &apps::Peer::name);
  ASSERT_NE(peer, all.end());
  if (const std::string reason = peer->missing(); !reason.empty()) GTEST_SKIP() << reason;
  const apps::StudyCase seen =
      apps::make_case(GetParam().scene, scene_named(GetParam().scene), {.width = 160, .height = 120});
  ASSERT_TRUE(apps::takes(*peer, seen.scene.lights.front().shape));
  const auto draw = [&](const char* method) {
    return render(seen.scene, {.method = method, .width = 160, .height = 120});
  };
  const RenderResult silhouette = draw("silhouette"), lit = draw("none");
  apps::Setting setting = peer->settings.front();
  setting.options["samples"] = GetParam().samples;
  const std::vector<apps::Measured> measured =
      peer->measure({.seen = seen, .unshadowed = lit.image, .rounds = 1, .threads = 2}, {&setting, 1});
  ASSERT_EQ(measured.size(), 1u);
  EXPECT_GT(measured.front().frames.front(), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < lit.image.at("A").size(); ++i)
    sum += std::abs(measured.front().visibility[i] - silhouette.lights.front().visibility[i]);
  EXPECT_LT(sum / (160 * 120), GetParam().mean_difference);
}

INSTANTIATE_TEST_SUITE_P(All, StudyPeer,
                         testing::Values(Expected{"povray", "torus-medium", 256, 0.02},
                                         Expected{"cycles", "torus-medium", 64, 0.002},
                                         Expected{"cycles", "terrain-sun", 64, 0.003},
                                         Expected{"threejs-pcss", "cube-medium", 64, 0.01},
                                         Expected{"threejs-pcss", "boxes-sun", 64, 0.01}),
                         [](const auto& parameter) {
                           std::string name = std::string(parameter.param.peer) + "_" + parameter.param.scene;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

/// A study of one scene, with programs before those that are installed.
class StudyWithPrograms : public ProgramTest {
 protected:
  StudyWithPrograms() {
    std::filesystem::create_directory(file("bin"));
    write("t.off", kTetrahedron);
    write("s.json", scene_text("t.off"));
    setenv("PATH", (path("bin") + ":" + before_).c_str(), 1);
  }
  ~StudyWithPrograms() override { setenv("PATH", before_.c_str(), 1); }

  void write_program(const std::string& name, const std::string& script) const {
    write("bin/" + name, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file("bin/" + name), std::filesystem::perms::owner_all);
  }
  Outcome study() const {
    return run({"study", path("s.json"), "--output", path("out"), "--size", "64x48", "--frames", "1",
                "--samples", "64", "--no-memory", "--peers", "--methods", "hard,povray,cycles,threejs-pcss"});
  }
  Json rows() const { return Json::parse(read_text(file("out") / "study.json"))["rows"]; }

  const std::string before_ = std::getenv("PATH");
};

TEST_F(StudyWithPrograms, ThatFailLoseNoOtherRows) {
  write_program("povray", R"([ "$1" = --version ])");
  write_program("blender", R"(for folder; do :; done; [ "$1" = --version ] || exit 0)");  // writes nothing
  const Outcome r = study();
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(rows().size(), 1u);
  EXPECT_NE(r.err.find("no rows of povray: POV-Ray failed"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("no rows of cycles: Blender wrote no times"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("no rows of threejs-pcss: --three is not given"), std::string::npos) << r.err;
  EXPECT_EQ(r.error_lines(), 3u) << r.err;
}

TEST_F(StudyWithPrograms, ThatAreMissingAreNamed) {
  for (const char* name : {"povray", "blender"}) write_program(name, "exit 127");
  const Outcome r = study();
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(rows().size(), 1u);
  EXPECT_NE(r.err.find("package blender"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("package povray"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace penumbra::test
