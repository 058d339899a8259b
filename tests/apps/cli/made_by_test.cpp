// Images say what made them, and compare says so.
#include "apps/cli/made_by.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "penumbra/render/image/image.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using nlohmann::json;

class MadeByTest : public ProgramTest {
 protected:
  MadeByTest() {
    write("t.off", kTetrahedron);
    scene_ = write("scene.json", scene_text("t.off"));
  }
  std::string drawn(const std::string& name, const std::string& scene, std::vector<std::string> more) const {
    std::vector<std::string> words = {"render", scene, "--size", "16x12", "--output", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).code, 0);
    return path(name);
  }
  std::string scene_;
};

TEST_F(MadeByTest, IsInTheFile) {
  const auto metadata =
      read_exr(
          drawn("r.exr", scene_, {"--method", "rays", "--samples", "16", "--seed", "18446744073709551615"}))
          .metadata;
  EXPECT_EQ(metadata.at("penumbraMethod"), "rays");
  EXPECT_EQ(metadata.at("penumbraScene"), scene_);
  EXPECT_FALSE(metadata.at("penumbraVersion").empty());
  EXPECT_EQ(json::parse(metadata.at("penumbraOptions")),
            (json{{"areas-up-to", 0}, {"denoise", "off"}, {"samples", 16}, {"seed", 18446744073709551615u}}));
  const json light = json::parse(metadata.at("penumbraLights")).at(0),
             camera = json::parse(metadata.at("penumbraCamera"));
  EXPECT_EQ(light.at("shape"), "disk");
  EXPECT_EQ(light.at("center"), (json{0.0, 4.0, 0.0}));
  EXPECT_EQ(light.at("radius"), 0.5);
  EXPECT_EQ(camera.at("eye"), (json{3.0, 3.0, 4.0}));
  EXPECT_EQ(run({"render", scene_, "--size", "16x12", "--output", path("again.exr"), "--method", "rays",
                 "--samples", "16", "--seed", "18446744073709551615"})
                .code,
            0);
  EXPECT_EQ(read_text(file("r.exr")), read_text(file("again.exr"))) << "nothing of the day or the machine";
}

TEST_F(MadeByTest, IsSaidByCompare) {
  const std::string a = drawn("a.exr", scene_, {}),
                    b = drawn("b.exr", scene_, {"--method", "rays", "--samples", "16"});
  const std::string out = run({"compare", a, b}).out;
  EXPECT_NE(out.find("A " + a + ": auto of " + scene_ + " by penumbra "), std::string::npos) << out;
  EXPECT_NE(out.find("B " + b + ": rays (samples 16, seed 1) of " + scene_), std::string::npos) << out;
  const json report = json::parse(run({"compare", a, b, "--json"}).out);
  EXPECT_EQ(report.at("image_made_by").at("method"), "auto");
  EXPECT_EQ(report.at("reference_made_by").at("options").at("samples"), 16);
}

TEST_F(MadeByTest, DifferencesAreWarnedOf) {
  const std::string other =
      write("other.json", scene_text("t.off", "", R"("normal":[0,-1,0],"radius":0.25)"));
  const std::string a = drawn("a.exr", scene_, {}), b = drawn("b.exr", other, {});
  for (const std::string& reference : {b, other}) {
    const Outcome outcome = run({"compare", a, reference, "--samples", "16"});
    EXPECT_NE(outcome.err.find("A and B differ in lights"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(run({"compare", a, scene_, "--samples", "16"}).err, "");
}

TEST(MadeBy, IsUnknownOfOtherFiles) {
  EXPECT_EQ(apps::made_by({}), "does not say what made it");
  EXPECT_TRUE(apps::made_by_json({}).is_null());
  EXPECT_EQ(apps::made_by({{"penumbraMethod", "x"}, {"penumbraOptions", "{"}}), "x of  by penumbra ");
}

}  // namespace
}  // namespace penumbra::test
