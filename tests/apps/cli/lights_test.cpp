// Lights on the command line: distant ones, and those that light nothing.
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Json = nlohmann::json;

class LightsTest : public ProgramTest {
 protected:
  /// The tetrahedron above a floor that does not cast, under these lights.
  std::string scene(const Json& lights) const {
    write("t.off", kTetrahedron);
    write("floor.off", "OFF\n4 2 0\n-9 0 -9\n9 0 -9\n9 0 9\n-9 0 9\n3 0 2 1\n3 0 3 2\n");
    const Json document = {{"version", 1},
                           {"lights", lights},
                           {"camera", {{"eye", {3, 4, 5}}, {"target", {0, 0.4, 0}}}},
                           {"objects", {{{"mesh", "floor.off"}, {"casts", false}}, {{"mesh", "t.off"}}}}};
    return write("s.json", document.dump());
  }
  Outcome render(const Json& lights, const std::string& method = "silhouette") const {
    return run({"render", "--strict", scene(lights), "--method", method, "--size", "64x48", "--output",
                path("a.exr"), "--probe", "40,40"});
  }
};

Json sun(const Json& direction, double angle = 2.0) {
  return {{"shape", "distant"}, {"direction", direction}, {"angle_degrees", angle}, {"irradiance", 3}};
}

TEST_F(LightsTest, ASunLightsTheFloor) {
  const Outcome r = render(Json::array({sun({0, -1, 0})}), "none");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.err, "");
  const Json probe = Json::parse(r.out);
  EXPECT_EQ(probe["object"], 0);
  EXPECT_NEAR(probe["rgb"][1].get<double>(), 0.8 * 3.0 / std::numbers::pi, 1e-6);
}

TEST_F(LightsTest, MethodsSayWhichLightsTheyTake) {
  const Outcome r = run({"methods", "--json"});
  ASSERT_EQ(r.code, 0) << r.err;
  bool any = false;
  for (const Json& method : Json::parse(r.out)) {
    const bool takes = method["lights"].get<std::string>().find("distant") != std::string::npos;
    const Outcome picture = render(Json::array({sun({0.2, -1, 0.1})}), method["name"]);
    EXPECT_EQ(picture.code, takes ? 0 : 2) << method["name"] << picture.err;
    any |= takes;
  }
  EXPECT_TRUE(any);
}

TEST_F(LightsTest, ThatLightNothingAreSaidInOneLine) {
  const Json away = {{"shape", "disk"}, {"center", {0, 4, 0}}, {"normal", {0, 1, 0}}, {"radius", 0.5}};
  const Json inside = {
      {"shape", "disk"}, {"center", {0.3, 0.35, 0.3}}, {"normal", {0, -1, 0}}, {"radius", 0.01}};
  const Json above = {{"shape", "disk"}, {"center", {0, 4, 0}}, {"normal", {0, -1, 0}}, {"radius", 0.5}};
  const std::pair<Json, const char*> cases[] = {
      {away, "turn the light's normal"}, {inside, "inside of one"}, {sun({0.2, 1, 0.1}), "faces away"}};
  for (const auto& [light, what] : cases) {
    const Outcome r = render(Json::array({light}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.error_lines(), 1u) << r.err;
    EXPECT_NE(r.err.find("warning: the light lights nothing that is seen"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find(what), std::string::npos) << r.err;
  }
  Json named = away;
  named["name"] = "lamp";
  const Outcome r = render(Json::array({above, named}));
  EXPECT_EQ(r.error_lines(), 1u) << r.err;
  EXPECT_NE(r.err.find("light lamp lights nothing"), std::string::npos) << r.err;
  EXPECT_EQ(render(Json::array({above})).err, "");
}

}  // namespace
}  // namespace penumbra::test
