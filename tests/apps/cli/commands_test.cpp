// Every subcommand does what its help says.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "penumbra/render/image/image.h"
#include "tests/apps/cli/program.h"

namespace penumbra::test {
namespace {

using Json = nlohmann::json;

class CommandTest : public ProgramTest {
 protected:
  CommandTest() : scene_(PENUMBRA_DATA "/scenes/cube-medium.json") { write("t.off", kTetrahedron); }
  Outcome fine(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome;
  }
  std::string scene_;
};

TEST_F(CommandTest, HelpAndVersionAreFine) {
  EXPECT_TRUE(fine({"--version"}).out.starts_with("penumbra 0."));
  EXPECT_NE(fine({"--help"}).out.find("Exit codes"), std::string::npos);
  for (const char* command : {"render", "volumes", "inspect", "classify", "compare"})
    EXPECT_NE(fine({command, "--help"}).out.find("Examples:"), std::string::npos) << command;
}

TEST_F(CommandTest, RectanglesAreRefusedInOneLineWhereADiskIsNeeded) {
  const std::string scene = PENUMBRA_DATA "/scenes/textures6.json";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"classify", scene},
        {"volumes", scene, "--report", "-"},
        {"render", scene, "--method", "silhouette", "--size", "16x12", "--stats", "-"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments[0];
    EXPECT_NE(outcome.err.find("needs a disk light"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(CommandTest, OcclusionTexturesSayTheirOptions) {
  const Json stats = Json::parse(fine({"render",         PENUMBRA_DATA "/scenes/textures6.json",
                                       "--size",         "32x24",
                                       "--method",       "occlusion-textures",
                                       "--slices",       "8",
                                       "--filter",       "nbuffer",
                                       "--texture-size", "128",
                                       "--combine",      "sum",
                                       "--cop-offset",   "orthographic",
                                       "--kernel",       "disk",
                                       "--thin-fix",     "auto",
                                       "--slice-range",  "casters",
                                       "--slice-faces",  "all",
                                       "--coverage",     "area",
                                       "--stats",        "-"})
                                     .out);
  EXPECT_EQ(stats["options"]["cop-offset"], "orthographic");
  EXPECT_EQ(stats["options"]["filter"], "nbuffer");
  EXPECT_EQ(stats["counts"]["thin_casters"], 1);
  for (const char* stage : {"frustum", "slices", "read_back", "prefilter", "visibility"})
    EXPECT_TRUE(stats["stages"].contains(stage)) << stage;
  const std::string scene = PENUMBRA_DATA "/scenes/textures6.json";
  for (const std::vector<std::string>& bad : {std::vector<std::string>{"--slices", "5"},
                                              {"--texture-size", "100"},
                                              {"--filter", "fft"},
                                              {"--cop-offset", "0"},
                                              {"--cop-offset", "nan"},
                                              {"--cop-offset", "near"}}) {
    std::vector<std::string> arguments{"render", scene, "--stats", "-"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    EXPECT_EQ(run(arguments).code, 2) << bad[0] << " " << bad[1];
  }
}

TEST_F(CommandTest, InspectAsTextAndJson) {
  EXPECT_NE(fine({"inspect", path("t.off")}).out, "");
  const Json findings = Json::parse(fine({"inspect", "--json", path("t.off")}).out);
  EXPECT_EQ(findings["faces"], 4);
  EXPECT_EQ(findings["closed"], true);
}

TEST_F(CommandTest, InspectReportsEveryFindingByName) {
  const std::string mesh = write("odd.off",
                                 "OFF\n5 4 0\n5 0 0\n6 0 0\n5 1 0\n0 0 0\n0 0 1\n"
                                 "3 0 1 2\n3 0 1 2\n3 0 0 1\n3 3 4 2\n");
  const Json json = Json::parse(fine({"inspect", mesh, "--json"}).out);
  EXPECT_EQ(json.at("faces"), 3);
  EXPECT_EQ(json.at("closed"), false);
  EXPECT_EQ(json.at("bounds").at("low"), Json::array({0.0, 0.0, 0.0}));
  EXPECT_EQ(json.at("bounds").at("high"), Json::array({6.0, 1.0, 1.0}));
  EXPECT_EQ(json.at("build").at("duplicates"), Json::array({1}));
  EXPECT_EQ(json.at("build").at("degenerate"), Json::array({2}));
  for (const char* key : {"vertices", "edges", "components", "closed_components", "boundary_edges",
                          "boundary_vertices", "signed_volume", "surface_area"})
    EXPECT_TRUE(json.at(key).is_number()) << key;
}

TEST_F(CommandTest, VolumesAreWrittenWhateverTheCaseOfTheExtension) {
  fine({"volumes", scene_, "--penumbra", path("p.OBJ"), "--form", "cells"});
  EXPECT_TRUE(std::filesystem::exists(file("p.OBJ")));
}

TEST_F(CommandTest, ClassifyCountsAgreeWithLists) {
  EXPECT_NE(fine({"classify", scene_}).out.find("cube.off"), std::string::npos);
  const Json report = Json::parse(fine({"classify", scene_, "--json", "--threads", "1"}).out);
  ASSERT_EQ(report["objects"].size(), 2u);
  const Json& cube = report["objects"][1];
  EXPECT_EQ(cube["faces"], 12);
  EXPECT_EQ(cube["face_classes"].size(), 12u);
  for (const auto& [name, number] : {std::pair("none_front", 0), {"mixed", 1}, {"all_front", 2}}) {
    const Json& list = cube["face_classes"];
    EXPECT_EQ(cube["classes"][name].get<long>(), std::count(list.begin(), list.end(), number)) << name;
  }
  EXPECT_EQ(cube["edges"]["band"].size(), cube["silhouettes"]["band"].get<std::size_t>());
  EXPECT_GT(cube["edges"]["penumbra"].size(), 2u);
}

TEST_F(CommandTest, VolumesAndReport) {
  const Json report =
      Json::parse(fine({"volumes", scene_, "--form", "cells", "--umbra", path("u.ply"), "--penumbra",
                        path("p.obj"), "--sheets", path("s.ply"), "--report", "-"})
                      .out);
  for (const char* name : {"u.ply", "p.obj", "s.ply"})
    EXPECT_TRUE(std::filesystem::exists(file(name))) << name;
  ASSERT_EQ(report["objects"].size(), 1u);  // the floor does not cast
  const Json& cube = report["objects"][0];
  EXPECT_EQ(cube["object"], 1);
  EXPECT_EQ(cube["penumbra"]["guarantee"], "contains");
  EXPECT_GT(cube["penumbra"]["triangles"], 8);
  EXPECT_GT(cube["penumbra"]["signed_volume"], 0.0);
  EXPECT_GE(cube["milliseconds"]["penumbra"], 0.0);
  EXPECT_FALSE(report.contains("scene"));
}

TEST_F(CommandTest, MergedVolumesAreReportedForTheScene) {
  const Json report = Json::parse(
      fine({"volumes", scene_, "--form", "cells", "--merge", "--report", "-", "--penumbra", path("p.ply")})
          .out);
  EXPECT_EQ(report["scene"]["penumbra"]["triangles"], report["objects"][0]["penumbra"]["triangles"]);
}

TEST_F(CommandTest, FilesAreSolidsUnlessCellsAreAskedFor) {
  const Json report = Json::parse(fine({"volumes", scene_, "--umbra", path("u.ply"), "--penumbra",
                                        path("p.ply"), "--sheets", path("s.ply"), "--check", "--report", "-"})
                                      .out);
  const Json& cube = report["objects"].at(0);
  for (const char* kind : {"umbra", "penumbra"}) {
    EXPECT_EQ(cube[kind]["guarantee"], "certified") << kind;
    EXPECT_EQ(cube[kind]["check"]["good"], true) << kind;
    EXPECT_GT(cube[kind]["volume"], 0.0) << kind;
  }
  EXPECT_GT(report["sheets"].at(0)["sheets"]["triangles"], 8);
  for (const char* name : {"u.ply", "p.ply"})
    EXPECT_EQ(Json::parse(fine({"inspect", path(name), "--json"}).out)["closed"], true) << name;
  // Without files it is cells that are reported and checked.
  EXPECT_EQ(
      Json::parse(fine({"volumes", scene_, "--report", "-"}).out)["objects"].at(0)["penumbra"]["guarantee"],
      "contains");
}

TEST_F(CommandTest, SectionsOfSolidsAreCurves) {
  fine({"volumes", scene_, "--umbra", path("u.ply"), "--penumbra", path("p.ply")});
  const Json report = Json::parse(fine({"section", path("p.ply"), path("u.ply"), "--point", "0,0.2,0",
                                        "--output", path("s.svg"), "--report", "-"})
                                      .out);
  ASSERT_EQ(report["sections"].size(), 2u);
  EXPECT_GT(report["sections"][0]["area"], report["sections"][1]["area"]);
  EXPECT_GT(report["sections"][1]["area"], 0.0);
  EXPECT_EQ(report["sections"][0]["closed_curves"], report["sections"][0]["curves"]);
  EXPECT_TRUE(std::filesystem::exists(file("s.svg")));
}

TEST_F(CommandTest, UmbraOfAConvexCasterIsExactAndChecked) {
  const std::string scene = write("one.json", scene_text("t.off"));
  const Json report = Json::parse(fine({"volumes", scene, "--check", "--report", "-"}).out);
  const Json& caster = report["objects"][0];
  EXPECT_EQ(caster["umbra"]["guarantee"], "exact");
  EXPECT_GT(caster["umbra"]["signed_volume"], 0.0);
  EXPECT_EQ(caster["check"]["good"], true);
  EXPECT_EQ(caster["check"]["umbra"]["bounds_a_volume"], true);
  EXPECT_EQ(caster["check"]["umbra_in_hard"]["outside"], 0);
  EXPECT_NE(fine({"volumes", scene_, "--check"}).out.find(": good"), std::string::npos);
}

TEST_F(CommandTest, RepairWritesAMendedMeshAndSaysWhatWasDone) {
  const std::string turned = write("turned.off",
                                   "OFF\n4 4 0\n0 0 0\n1 0 0\n0 0 1\n0.2 1 0.2\n"
                                   "3 0 1 2\n3 0 3 1\n3 1 3 2\n3 2 0 3\n");
  const Json report = Json::parse(fine({"inspect", turned, "--json", "--repair", path("mended.ply")}).out);
  EXPECT_EQ(report["closed"], false);
  ASSERT_EQ(report["repair"]["components"].size(), 1u);
  EXPECT_EQ(report["repair"]["components"][0]["verdict"], "mended");
  EXPECT_EQ(report["repair"]["components"][0]["flipped"], Json::array({3}));
  EXPECT_EQ(Json::parse(fine({"inspect", path("mended.ply"), "--json"}).out)["closed"], true);
  EXPECT_EQ(run({"inspect", turned, "--repair", path("mended.xyz")}).code, 2);
}

TEST_F(CommandTest, UnknownKeysWarnOnOneLineEach) {
  const std::string odd = write("odd.json", scene_text("t.off", R"(,"color":[1,0,0],"x-note":"kept")"));
  const Outcome outcome = run({"classify", odd});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.error_lines(), 1u) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: " + odd + ": /objects/0/color"), std::string::npos) << outcome.err;
  const Outcome near = run({"classify", write("near.json", scene_text("t.off", R"(,"Albeto":1)"))});
  EXPECT_NE(near.err.find("unknown key (did you mean albedo?)"), std::string::npos) << near.err;
}

TEST_F(CommandTest, RenderWritesBothFormatsAndStats) {
  fine({"render", scene_, "--method", "hard", "--size", "64x48", "--output", path("h.png"), "--output",
        path("h.exr"), "--stats", path("h.json")});
  EXPECT_TRUE(read_text(file("h.png")).starts_with("\x89PNG"));
  const Image image = read_exr(file("h.exr"));
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 48);
  for (const char* name :
       {"R", "G", "B", "A", "visibility", "region", "object", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"})
    EXPECT_TRUE(image.has(name)) << name;
  const Json stats = Json::parse(read_text(file("h.json")));
  EXPECT_TRUE(stats.contains("frame_ms"));
  EXPECT_TRUE(stats.contains("stages"));
}

TEST_F(CommandTest, RenderToStandardOutput) {
  EXPECT_TRUE(fine({"render", "--method", "none", "--size", "32x24", scene_, "--output", "-"})
                  .out.starts_with("\x89PNG"));
}

TEST_F(CommandTest, RenderOfABareMeshShowsFloorAndMesh) {
  fine({"render", path("t.off"), "--method", "none", "--size", "64x48", "--output", path("t.exr")});
  const Image image = read_exr(file("t.exr"));
  const std::vector<float>& object = image.at("object");
  EXPECT_GT(std::count(object.begin(), object.end(), 0.0f), 500);
  EXPECT_GT(std::count(object.begin(), object.end(), 1.0f), 100);
}

TEST_F(CommandTest, ProbeTellsWhatIsAtAPixel) {
  const Json probe =
      Json::parse(fine({"render", scene_, "--method", "hard", "--size", "64x48", "--probe", "32,40"}).out);
  EXPECT_EQ(probe["object"], 0);
  EXPECT_EQ(probe["P"].size(), 3u);
  EXPECT_NEAR(probe["P"][1].get<double>(), 0.0, 1e-9);  // the floor's top
  EXPECT_NEAR(probe["N"][1].get<double>(), 1.0, 1e-12);
  EXPECT_EQ(probe["reference"]["samples"], 4096);
}

TEST_F(CommandTest, CompareToSceneFindsTheNoiseOfFewSamples) {
  fine({"render", scene_, "--method", "reference", "--samples", "64", "--seed", "7", "--size", "96x72",
        "--output", path("r.exr")});
  const Json report = Json::parse(
      fine({"compare", path("r.exr"), scene_, "--samples", "1024", "--json", "--picture", path("p.png")})
          .out);
  const double rmse = report["penumbra"]["rmse"].get<double>();
  EXPECT_GT(rmse, 0.005);  // 64 stratified rays reach about .017
  EXPECT_LT(rmse, 0.03);
  EXPECT_LE(report["penumbra"]["rmse_low"].get<double>(), rmse);
  EXPECT_GE(report["penumbra"]["rmse_high"].get<double>(), rmse);
  EXPECT_EQ(report["resampled_pixels"], 20) << "its errors are far above the references' noise";
  EXPECT_TRUE(read_text(file("p.png")).starts_with("\x89PNG"));
  fine({"render", scene_, "--method", "silhouette", "--size", "96x72", "--output", path("s.exr")});
  const Json exact = Json::parse(fine({"compare", path("s.exr"), scene_, "--samples", "256", "--json"}).out);
  EXPECT_GT(exact["resampled_pixels"], 20);
}

TEST_F(CommandTest, CompareByTheOracleJudgesErrorsAndCertificates) {
  fine({"render", scene_, "--size", "96x72", "--output", path("s.exr")});
  const Json report = Json::parse(
      fine({"compare", path("s.exr"), scene_, "--judge", "double", "--samples", "256", "--json"}).out);
  EXPECT_EQ(report["judge"], "double");
  const Image drawn = read_exr(file("s.exr"));
  EXPECT_EQ(report["all"]["pixels"].get<int>() + report["skipped_pixels"].get<int>(),
            std::ranges::count_if(drawn.at("object"), [](float object) { return object >= 0.0f; }));
  EXPECT_LT(report["penumbra"]["rmse"], 0.002);
  EXPECT_GT(report["certified_pixels"], 1000);
  EXPECT_EQ(report["contradicted_pixels"], 0);

  // Lit pixels that claim to be in umbra, and a shadow that is not seen.
  Image image = drawn;
  int lit = 0;
  for (float& region : image.channels.at("region"))
    if (region == 0.0f && lit < 10) region = 2.0f, ++lit;
  image.channels.at("visibility").assign(96 * 72, 1.0f);
  write_exr(file("w.exr"), image);
  const Json wrong = Json::parse(
      fine({"compare", path("w.exr"), scene_, "--judge", "double", "--samples", "256", "--json"}).out);
  EXPECT_EQ(wrong["contradicted_pixels"], lit);
  EXPECT_GT(wrong["penumbra"]["rmse"], 0.3);
}

TEST_F(CommandTest, CompareByTheOracleMissesObjectsThatAreNotDrawn) {
  fine({"render", scene_, "--method", "none", "--size", "64x48", "--output", path("n.exr")});
  Image image = read_exr(file("n.exr"));
  for (float& object : image.channels.at("object"))
    if (object == 1.0f) object = -1.0f;
  write_exr(file("m.exr"), image);
  const Outcome outcome = run({"compare", path("m.exr"), scene_, "--judge", "double"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("not rendered from this scene"), std::string::npos) << outcome.err;
}

TEST_F(CommandTest, CompareRefusesAnotherScene) {
  fine({"render", scene_, "--method", "none", "--size", "64x48", "--output", path("n.exr")});
  const Outcome outcome = run({"compare", path("n.exr"), path("t.off")});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_NE(outcome.err.find("not rendered from this scene"), std::string::npos) << outcome.err;
}

TEST_F(CommandTest, CompareOfAnImageWithItselfIsZero) {
  fine({"render", scene_, "--method", "reference", "--samples", "16", "--size", "64x48", "--output",
        path("r.exr")});
  const Json report = Json::parse(fine({"compare", path("r.exr"), path("r.exr"), "--json", "--object", "0",
                                        "--signed-difference", path("d.png")})
                                      .out);
  EXPECT_EQ(report["all"]["rmse"], 0.0);
  EXPECT_EQ(report["all"]["max_absolute"], 0.0);
  EXPECT_EQ(report["object"], 0);
}

}  // namespace
}  // namespace penumbra::test
