// A method from outside of the library: one registration, and every command knows it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/cli/command_line.h"
#include "penumbra/mesh/error.h"
#include "penumbra/render/image/image.h"
#include "tests/apps/cli/program.h"
#include "tests/apps/toy_method.h"

namespace penumbra::test {
namespace {

using Json = nlohmann::json;

class ToyMethodTest : public ProgramTest {
 protected:
  static void SetUpTestSuite() { require_toy(); }
  ToyMethodTest() : scene_(write("s.json", scene_text("t.off"))) { write("t.off", kTetrahedron); }

  /// In this process: the program itself does not know the method.
  Outcome run_here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "penumbra");
    std::vector<char*> argv;
    for (std::string& each : arguments) argv.push_back(each.data());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Outcome out;
    out.code = apps::run_command_line(static_cast<int>(argv.size()), argv.data());
    out.out = testing::internal::GetCapturedStdout();
    out.err = testing::internal::GetCapturedStderr();
    return out;
  }
  Json stats_with(const std::vector<std::string>& options) const {
    std::vector<std::string> all{"render", scene_, "--size", "16x12", "--method", "toy", "--stats", "-"};
    all.insert(all.end(), options.begin(), options.end());
    const Outcome r = run_here(all);
    EXPECT_EQ(r.code, 0) << r.err;
    return Json::parse(r.out);
  }

  std::string scene_;
};

TEST_F(ToyMethodTest, CanBeChosen) {
  const Outcome r = run_here({"render", scene_, "--size", "64x48", "--method", "toy", "--toy-share", "0.75",
                              "--output", path("toy.exr")});
  ASSERT_EQ(r.code, 0) << r.err;
  const Image image = read_exr(file("toy.exr"));
  const std::vector<float>&visibility = image.at("visibility"), &object = image.at("object");
  std::size_t seen = 0;
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    EXPECT_EQ(visibility[i], object[i] < 0.0f ? 1.0f : 0.75f) << i;
    seen += object[i] >= 0.0f;
  }
  EXPECT_GT(seen, 50u);
}

TEST_F(ToyMethodTest, IsInTheHelpWithItsOption) {
  const Outcome r = run_here({"render", "--help"});
  EXPECT_EQ(r.code, 0);
  for (const char* text : {"Method toy: the same share everywhere", "--toy-share", "What every receiver sees",
                           "0 to 1 of the light", "0.25"})
    EXPECT_NE(r.out.find(text), std::string::npos) << text << " in\n" << r.out;
}

TEST_F(ToyMethodTest, RefusesWhatItsOptionDoesNotAllow) {
  for (const char* share : {"1.5", "-0.1", "much", "nan"}) {
    const Outcome r = run_here({"render", scene_, "--method", "toy", "--toy-share", share, "--stats", "-"});
    EXPECT_EQ(r.code, 2) << share;
    EXPECT_EQ(r.error_lines(), 1u) << r.err;
    EXPECT_NE(r.err.find("--toy-share"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("0 to 1 of the light"), std::string::npos) << r.err;
    EXPECT_TRUE(r.out.empty()) << r.out;
  }
}

TEST_F(ToyMethodTest, IsInTheStats) {
  const Json given = stats_with({"--toy-share", "0.5"}), usual = stats_with({});
  EXPECT_EQ(given["method"], "toy");
  EXPECT_EQ(given["options"], Json({{"toy-share", 0.5}}));
  EXPECT_EQ(usual["options"], Json({{"toy-share", 0.25}}));
  EXPECT_EQ(given["counts"], Json({{"toys", 7}}));
  EXPECT_EQ(given["stages"]["toy"], 0.25);
}

TEST_F(ToyMethodTest, IsListedWhereAMethodIsUnknown) {
  const Outcome r = run_here({"render", scene_, "--method", "toys", "--stats", "-"});
  EXPECT_EQ(r.code, 2);
  EXPECT_NE(r.err.find("'toys'"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find(", toy"), std::string::npos) << r.err;
}

TEST_F(ToyMethodTest, IsRegisteredOnce) {
  EXPECT_THROW(register_toy(), UsageError);
}

}  // namespace
}  // namespace penumbra::test
