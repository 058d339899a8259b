// penumbra plan, and pictures that are drawn by plans.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "penumbra/render/image/image.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Json = nlohmann::json;

class PlanCommandTest : public ProgramTest {
 protected:
  Outcome fine(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome;
  }
  const std::string scene_ = PENUMBRA_DATA "/scenes/foliage-medium.json";
  const std::string square_ = PENUMBRA_DATA "/plan/square.json";
};

// Of four lights, of which two are left out; of one of them both say that it lights nothing.
TEST_F(PlanCommandTest, APlanThatIsKeptDrawsThePictureOfAuto) {
  fine({"plan", square_, "--size", "96x72", "--output", path("plan.json")});
  const Outcome by_plan =
      run({"render", square_, "--size", "96x72", "--plan", path("plan.json"), "--output", path("kept.exr")});
  const Outcome by_auto =
      run({"render", square_, "--size", "96x72", "--method", "auto", "--output", path("auto.exr")});
  EXPECT_EQ(by_plan.code, 0) << by_plan.err;
  EXPECT_EQ(by_plan.err, by_auto.err);
  const Image kept = read_exr(file("kept.exr")), planned = read_exr(file("auto.exr"));
  for (const char* light : {"lamp", "far-lamp", "sign", "beacon"}) {
    const std::string channel = std::string("visibility.") + light;
    EXPECT_EQ(kept.at(channel), planned.at(channel)) << light;
  }
}

TEST_F(PlanCommandTest, APlanIsDoneAsItIsEdited) {
  fine({"plan", scene_, "--size", "64x48", "--output", path("plan.json")});
  const Outcome over = run({"render", scene_, "--plan", path("plan.json"), "--stats", path("plan.json")});
  EXPECT_EQ(over.code, 2);
  EXPECT_NE(over.err.find("would replace the input"), std::string::npos) << over.err;
  Json plan = Json::parse(read_text(file("plan.json")));
  plan["lights"][0]["method"] = "reference";
  plan["lights"][0]["options"] = {{"samples", 9}};
  write("edited.json", plan.dump());
  const Json stats = Json::parse(
      fine({"render", scene_, "--size", "64x48", "--plan", path("edited.json"), "--stats", "-"}).out);
  EXPECT_EQ(stats["method"], "plan");
  EXPECT_EQ(stats["decisions"][0]["choice"], "reference");
  EXPECT_LE(stats["counts"]["rays"].get<int>(), 9 * 64 * 48);
}

TEST_F(PlanCommandTest, PlansThatDoNotSuitAreRefusedInOneLine) {
  fine({"plan", scene_, "--size", "64x48", "--output", path("plan.json")});
  const Json plan = Json::parse(read_text(file("plan.json")));
  const auto with = [&](const char* key, const Json& value) {
    Json other = plan;
    other["lights"][0][key] = value;
    return other;
  };
  const std::vector<std::pair<Json, std::string>> cases{{with("method", "nonsense"), "nonsense"},
                                                        {with("action", "dance"), "dance"},
                                                        {with("options", {{"slices", 8}}), "slices"},
                                                        {with("left_out", {99}), "99"},
                                                        {with("light", "moon"), "moon"},
                                                        {Json{{"lights", Json::array()}}, "0 lights"},
                                                        {Json::array(), "plan"}};
  for (const auto& [json, word] : cases) {
    write("bad.json", json.dump());
    const Outcome outcome =
        run({"render", scene_, "--size", "64x48", "--plan", path("bad.json"), "--stats", "-"});
    EXPECT_EQ(outcome.code, 2) << json.dump();
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
  }
}

TEST_F(PlanCommandTest, EffectsAreForced) {
  const auto plan_of = [&](const std::string& effect) {
    return Json::parse(
        fine({"plan", scene_, "--size", "64x48", "--effect", effect, "--json"}).out)["lights"][0];
  };
  EXPECT_EQ(plan_of("shadows=off")["action"], "no shadows");
  EXPECT_EQ(plan_of("penumbra=off")["method"], "hard");
  EXPECT_EQ(plan_of("areas=on")["method"], "silhouette");
  EXPECT_EQ(plan_of("certificates=off")["method"], "reference");
  for (const char* bad : {"shadows", "shadows=maybe", "fog=on", "=on"}) {
    const Outcome outcome = run({"plan", scene_, "--effect", bad});
    EXPECT_EQ(outcome.code, 2) << bad;
    EXPECT_NE(outcome.err.find("certificates"), std::string::npos) << outcome.err;
  }
}

TEST_F(PlanCommandTest, ABudgetThatNoMethodKeepsIsSaid) {
  const Outcome outcome = run({"render", scene_, "--size", "64x48", "--method", "auto", "--max-ms", "0.0001",
                               "--output", path("hurried.exr")});
  EXPECT_EQ(outcome.code, 0) << "there is a picture";
  EXPECT_NE(outcome.err.find("no method keeps"), std::string::npos) << outcome.err;
  fine({"render", scene_, "--size", "64x48", "--method", "auto", "--output", path("at-ease.exr")});
}

TEST_F(PlanCommandTest, TimesAreThoseOfAMachineOfThatSpeed) {
  const auto ms_at = [&](const char* speed) {
    return Json::parse(fine({"plan", scene_, "--size", "64x48", "--plan-speed", speed, "--json"})
                           .out)["lights"][0]["predicted_ms"]
        .get<double>();
  };
  EXPECT_NEAR(ms_at("1"), 4.0 * ms_at("4"), 1e-6);
  EXPECT_NE(fine({"plan", scene_, "--max-ms", "20"}).out.find("assumed"), std::string::npos);
}

TEST_F(PlanCommandTest, ThePictureShowsWhatIsDone) {
  const std::string out =
      fine({"plan", scene_, "--size", "96x72", "--effect", "areas=on", "--picture", path("p.png")}).out;
  EXPECT_NE(out.find("area"), std::string::npos);
  EXPECT_NE(out.find("certified lit"), std::string::npos);
  EXPECT_EQ(out.find("rays  "), std::string::npos) << "none is left to rays";
  EXPECT_TRUE(std::filesystem::exists(file("p.png")));
}

}  // namespace
}  // namespace penumbra::test
