// The real window under Xvfb, driven by xdotool: what a hand does shows in the state and in the pictures.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#include <stb_image.h>

#include <fstream>
#include <set>

#include "penumbra/render/renderer.h"
#include "tests/apps/viewer/window_driver.h"

namespace penumbra::test {
namespace {

const std::string kCube = PENUMBRA_DATA "/scenes/cube-medium.json";

// Distinct colors of the left `width` columns: a blank window has one.
std::size_t colors(const std::filesystem::path& path, int columns) {
  int width = 0, height = 0, channels = 0;
  unsigned char* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
  if (!pixels) return 0;
  std::set<int> found;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < std::min(columns, width); ++x) {
      const unsigned char* p = pixels + 3 * (y * width + x);
      found.insert(p[0] << 16 | p[1] << 8 | p[2]);
    }
  stbi_image_free(pixels);
  return found.size();
}

TEST_F(WindowTest, StartsOnSceneAndMeshes) {
  for (const std::string& each : {kCube, std::string(PENUMBRA_DATA "/meshes/bunny.ply"),
                                  std::string(PENUMBRA_DATA "/meshes/doll-house.ply")}) {
    Child window = start({each, "--size", "320x200", "--screenshot", path("w.png"), "--frames", "3"});
    ASSERT_EQ(window.wait(), 0) << read_text(file("errors"));
    EXPECT_GT(colors(file("w.png"), 320), 40u) << each;
  }
}

TEST_F(WindowTest, OverlaysAndProbeAreDrawn) {
  for (const char* overlay : {"faces", "silhouettes", "band", "sheets", "penumbra", "umbra", "penumbra-solid",
                              "umbra-solid", "textures"}) {
    Child plain = start({kCube, "--size", "320x200", "--plain", "--screenshot", path("plain.png")});
    ASSERT_EQ(plain.wait(), 0) << read_text(file("errors"));
    Child window =
        start({kCube, "--size", "320x200", "--overlay", overlay, "--probe", "--screenshot", path("w.png")});
    ASSERT_EQ(window.wait(), 0) << read_text(file("errors"));
    EXPECT_GT(colors(file("w.png"), 320), colors(file("plain.png"), 320)) << overlay;
  }
}

TEST_F(WindowTest, PlainWindowIsThePictureOfRender) {
  register_drawing_methods();
  for (const MethodInfo& info : methods()) {
    const std::string& method = info.name;
    Child window = start({kCube, "--size", "320x200", "--plain", "--method", method, "--samples", "32",
                          "--screenshot", path("w.png")});
    ASSERT_EQ(window.wait(), 0) << read_text(file("errors"));
    const Outcome cli = run({"render", kCube, "--size", "320x200", "--method", method, "--samples", "32",
                             "--output", path("c.png")});
    ASSERT_EQ(cli.code, 0) << cli.err;
    EXPECT_TRUE(read_text(file("w.png")) == read_text(file("c.png"))) << method;
  }
}

TEST_F(WindowTest, DragTurnsAndSavedPictureIsThatOfTheSavedState) {
  open({std::string(PENUMBRA_DATA "/meshes/bunny.ply"), "--size", "320x200"});
  const Json before = status();
  key("F12");
  until("the first picture saved",
        [](const Json& s) { return s["message"].get<std::string>().find("-001.png") != std::string::npos; });
  drag({160, 180}, 40, 0, "another eye",
       [&](const Json& s) { return s["camera"]["eye"] != before["camera"]["eye"]; });
  EXPECT_EQ(status()["camera"]["target"], before["camera"]["target"]);
  key("F12");
  until("the picture saved",
        [](const Json& s) { return s["message"].get<std::string>().find("-002.png") != std::string::npos; });
  EXPECT_NE(read_text(file("bunny-001.png")), read_text(file("bunny-002.png")));
  key("ctrl+s");
  until("the state saved",
        [](const Json& s) { return s["message"].get<std::string>().find(".json") != std::string::npos; });
  const Outcome cli =
      run({"render", "--strict", path("bunny-001.json"), "--size", "320x200", "--output", path("c.png")});
  ASSERT_EQ(cli.code, 0) << cli.err;
  EXPECT_EQ(read_text(file("bunny-002.png")), read_text(file("c.png")));
}

TEST_F(WindowTest, SliderAndHandlesChangeTheLight) {
  open({kCube, "--size", "480x700"});
  const Json opened = status()["camera"], before = status()["light"];
  key("shift+Home");
  const auto own = [&](const Json& s) { return s["camera"] != opened && s["handles"].contains("x"); };
  Json now = settled("the light in view", [&](const Json& s) {
    return own(s) && s["handles"]["center"][1].get<double>() > 0.0 &&
           s["handles"]["x"][0].get<double>() < 480.0;
  });
  drag(now["handles"]["x"], 15, 0, "another place",
       [&](const Json& s) { return s["light"]["center"] != before["center"]; });
  now = status();
  EXPECT_NE(now["light"]["center"][0], before["center"][0]);
  EXPECT_EQ(now["light"]["center"][1], before["center"][1]);
  EXPECT_EQ(now["light"]["center"][2], before["center"][2]);
  drag(now["handles"]["rim"], -12, 0, "another radius",
       [&](const Json& s) { return s["light"]["radius"] != before["radius"]; });
  now = status();
  EXPECT_GT(now["light"]["radius"], before["radius"]);
  drag(now["handles"]["normal"], 20, 0, "another tilt",
       [&](const Json& s) { return s["light"]["normal"] != before["normal"]; });
  now = status();
  drag(now["widgets"]["Radius"], -30, 0, "the slider's radius",
       [&](const Json& s) { return s["light"]["radius"] != now["light"]["radius"]; });
  key("ctrl+s");
  until("the state saved",
        [](const Json& s) { return s["message"].get<std::string>().find(".json") != std::string::npos; });
  const Json saved = Json::parse(read_text(file("cube-medium-001.json")));
  EXPECT_EQ(saved["lights"][0]["center"], status()["light"]["center"]);
  EXPECT_EQ(saved["lights"][0]["radius"], status()["light"]["radius"]);
  key("r");
  settled("the light as loaded", [&](const Json& s) { return s["light"]["center"] == before["center"]; });
}

TEST_F(WindowTest, ASunIsTurnedByItsCenterAndBySliders) {
  open({PENUMBRA_DATA "/scenes/boxes-sun.json", "--size", "480x700"});
  const Json opened = status()["camera"], before = status()["light"];
  key("shift+Home");
  Json now = settled("the sun in view", [&](const Json& s) {
    return s["camera"] != opened && s["handles"].contains("center") &&
           s["handles"]["center"][1].get<double>() > 20.0;
  });
  EXPECT_FALSE(now["handles"].contains("x")) << "it has no place";
  const auto turned = [&](const Json& s) { return s["light"]["direction"] != now["light"]["direction"]; };
  drag(now["handles"]["center"], 25, 10, "another direction", turned);
  EXPECT_EQ(status()["light"]["angle_degrees"], before["angle_degrees"]);
  now = status();
  drag(now["widgets"]["Elevation"], -30, 0, "another elevation", turned);
  now = status();
  drag(now["widgets"]["Angle"], 20, 0, "another angle",
       [&](const Json& s) { return s["light"]["angle_degrees"] != before["angle_degrees"]; });
  key("ctrl+s");
  until("the state saved",
        [](const Json& s) { return s["message"].get<std::string>().find(".json") != std::string::npos; });
  const Json saved = Json::parse(read_text(file("boxes-sun-001.json")))["lights"][0];
  EXPECT_EQ(saved["direction"], status()["light"]["direction"]);
  EXPECT_EQ(saved["angle_degrees"], status()["light"]["angle_degrees"]);
  EXPECT_NEAR(saved["irradiance"][0].get<double>(), 3.0, 1e-9);
  EXPECT_FALSE(saved.contains("radius"));
}

TEST_F(WindowTest, KeysChangeMethodAndArrangementAndTheDividerMoves) {
  open({kCube, "--size", "320x200"});
  const Json before = status();
  key("m");
  settled("another method", [&](const Json& s) { return s["method"] != before["method"]; });
  key("shift+m");
  settled("the method again", [&](const Json& s) { return s["method"] == before["method"]; });
  key("s");
  settled("two sides", [](const Json& s) { return s["frame"]["rays"].size() == 2; });
  drag({160, 185}, 60, 0, "another divider", [](const Json& s) { return s["divider"].get<double>() > 0.6; });
  EXPECT_EQ(status()["camera"], before["camera"]);
  key("d");
  settled("the difference", [](const Json& s) { return s["arrangement"] == 2; });
  until("more rays", [](const Json& s) { return s["frame"]["rays"][1].get<int>() > 256; });
  tool("mousemove 160 150 click 4");  // the wheel
  until("a nearer eye", [&](const Json& s) { return s["camera"]["eye"] != before["camera"]["eye"]; });
  key("7");
  until("the view from above", [](const Json& s) {
    return std::abs(s["camera"]["eye"][0].get<double>() - s["camera"]["target"][0].get<double>()) < 1e-6;
  });
  key("Escape");
  EXPECT_EQ(wait_for_end(), 0);
}

// The solids are those of the command line, the cells its cells.
TEST_F(WindowTest, ExportsSolidsCellsAndASequence) {
  open({kCube, "--size", "160x120"});
  const auto says = [](const char* words) {
    return
        [words](const Json& s) { return s["message"].get<std::string>().find(words) != std::string::npos; };
  };
  key("ctrl+e");
  until("the solids", says("cube-medium-001-{umbra,penumbra}.ply"));
  key("ctrl+shift+e");
  until("the cells", says("cube-medium-001-{sheets,penumbra-cells,umbra-cells}.ply"));
  for (const char* form : {"solid", "cells"}) {
    const std::string end = std::string(form) == "cells" ? "-cells.ply" : ".ply";
    const Outcome cli = run(
        {"volumes", kCube, "--merge", "--form", form, "--umbra", path("u.ply"), "--penumbra", path("p.ply")});
    ASSERT_EQ(cli.code, 0) << cli.err;
    EXPECT_TRUE(read_text(file("cube-medium-001-umbra" + end)) == read_text(file("u.ply"))) << form;
    EXPECT_TRUE(read_text(file("cube-medium-001-penumbra" + end)) == read_text(file("p.ply"))) << form;
  }
  EXPECT_TRUE(std::filesystem::exists(file("cube-medium-001-sheets.ply")));
  key("ctrl+p");
  until("the sequence", says("24 pictures"));
  EXPECT_TRUE(std::filesystem::exists(file("cube-medium-path-024.png")));
}

TEST_F(WindowTest, CertifiedRegionsAndVisibilityAreShown) {
  const auto shot = [&](const char* what) {
    Child window = start({kCube, "--size", "160x120", "--plain", "--method", "silhouette", "--show", what,
                          "--screenshot", path("w.png")});
    EXPECT_EQ(window.wait(), 0) << read_text(file("errors"));
    return colors(file("w.png"), 160);
  };
  EXPECT_EQ(shot("certified"), 4u) << "background, lit, umbra, not certified";
  EXPECT_GT(shot("visibility"), 20u);
}

TEST_F(WindowTest, DroppedFilesOpenAndBadOnesAreAMessage) {
  std::ofstream(file("broken.ply")) << "ply\nformat ascii 1.0\nelement vertex many\n";
  open({kCube, "--size", "160x120", "--drop", path("missing.obj")});
  until("a message", [](const Json& s) { return !s["message"].get<std::string>().empty(); });
  EXPECT_EQ(status()["file"], kCube);
  open({kCube, "--size", "160x120", "--drop", path("broken.ply")});
  until("a message", [](const Json& s) { return !s["message"].get<std::string>().empty(); });
  EXPECT_EQ(status()["file"], kCube);
  const std::string bunny = PENUMBRA_DATA "/meshes/bunny.ply";
  open({kCube, "--size", "160x120", "--drop", bunny});
  settled("the bunny", [&](const Json& s) { return s["file"] == bunny; });
}

TEST_F(WindowTest, ALostFileIsAMessage) {
  const std::string lost = path("lost.json");
  std::filesystem::copy_file(kCube, lost);
  open({kCube, lost, "--size", "160x120"});
  std::filesystem::remove(lost);
  key("Page_Down");
  until("a message",
        [](const Json& s) { return s["message"].get<std::string>().find("lost.json") != std::string::npos; });
  EXPECT_EQ(status()["file"], kCube);
}

TEST_F(WindowTest, IsResizedHiddenAndShownAgain) {
  open({kCube, "--size", "320x200"});
  EXPECT_EQ(tool("search --name Penumbra windowsize 850 420"), 0);
  settled("the new size", [](const Json& s) { return s["picture"] == Json({520, 393}); });
  EXPECT_EQ(tool("search --name Penumbra windowsize 40 30"), 0);
  settled("a tiny window", [](const Json& s) { return s["picture"][0] == 16; });
  EXPECT_EQ(tool("search --name Penumbra windowsize 700 300"), 0);
  settled("the size again", [](const Json& s) { return s["picture"] == Json({370, 273}); });
  EXPECT_EQ(tool("search --name Penumbra windowunmap"), 0);
  EXPECT_EQ(tool("search --name Penumbra windowmap --sync windowfocus --sync"), 0);
  key("m");
  settled("another method", [](const Json& s) { return s["method"] != "silhouette"; });
}

TEST_F(WindowTest, IsMinimisedAndRestored) {
  open({kCube, "--size", "320x200"});
  start_window_manager();
  until("the window minimised", [&](const Json&) {  // asked again until the window manager listens
    tool("search --name Penumbra windowminimize");
    return tool("search --onlyvisible --name Penumbra") != 0;
  });
  until("the window restored", [&](const Json&) {
    tool("search --name Penumbra windowmap");
    return tool("search --onlyvisible --name Penumbra windowactivate --sync") == 0;
  });
  key("m");
  settled("another method", [](const Json& s) { return s["method"] != "silhouette"; });
}

TEST_F(WindowTest, MiddleDragPansAndDoubleClickLooksAtAPoint) {
  open({kCube, "--size", "320x200"});
  const Json before = status()["camera"];
  drag(
      {160, 180}, 30, 10, "another target",
      [&](const Json& s) { return s["camera"]["target"] != before["target"]; }, 2);
  const Json panned = status()["camera"];
  for (const int k : {0, 1, 2})
    EXPECT_NEAR(panned["eye"][k].get<double>() - before["eye"][k].get<double>(),
                panned["target"][k].get<double>() - before["target"][k].get<double>(), 1e-9);
  tool("mousemove 100 170 click --repeat 2 --delay 150 1");
  settled("another center", [&](const Json& s) { return s["camera"]["target"] != panned["target"]; });
  EXPECT_EQ(status()["camera"]["eye"], panned["eye"]);
}

TEST_F(WindowTest, CutIsMovedAndTurned) {
  open({kCube, "--size", "400x760", "--overlay", "sheets"});
  Json now = status();
  drag(now["widgets"]["Cut"], -40, 0, "a nearer cut",
       [](const Json& s) { return s["cut"].get<double>() < 0.9; });
  const Json at =
      until("the slider let go", [](const Json& s) { return !s["holding"]; })["widgets"]["y##cut"];
  tool("mousemove " + std::to_string(at[0].get<int>()) + " " + std::to_string(at[1].get<int>()) + " click 1");
  until("another axis", [](const Json& s) { return s["cut_axis"] == 2; });
}

TEST_F(WindowTest, CopiedCommandMakesThePicture) {
  open({kCube, "--size", "160x120", "--method", "silhouette"});
  key("F12");
  until("the picture",
        [](const Json& s) { return s["message"].get<std::string>().find(".png") != std::string::npos; });
  key("ctrl+c");
  const Json now = until(
      "the command", [](const Json& s) { return s["message"].get<std::string>().starts_with("copied: "); });
  const std::string command = now["message"].get<std::string>().substr(8);
  EXPECT_EQ(clipboard(), command);
  std::filesystem::create_directory(file("elsewhere"));
  const std::string shell = "cd '" + path("elsewhere") + "' && PATH='" PENUMBRA_BIN "':\"$PATH\" " + command;
  ASSERT_EQ(std::system(shell.c_str()), 0) << shell;
  EXPECT_TRUE(read_text(file("cube-medium-001.png")) == read_text(file("elsewhere/cube-medium-001.png")))
      << command;
}

TEST_F(WindowTest, RandomInputNeitherCrashesNorGrows) {
  Child window = start({kCube, std::string(PENUMBRA_DATA "/meshes/bunny.ply"), "--size", "200x120",
                        "--random-input", "7", "--seconds", "20", "--output", file("").string()});
  EXPECT_EQ(window.wait(), 0) << read_text(file("errors"));
  EXPECT_NE(read_text(file("errors")).find("random input"), std::string::npos);
}

TEST_F(WindowTest, BadInputIsOneLineAndItsExitCode) {
  for (const auto& [arguments, code] : {std::pair(std::vector<std::string>{"nowhere.json"}, 3),
                                        {{kCube, "--color"}, 2},
                                        {{kCube, "--method", "magic"}, 2},
                                        {{kCube, "--size", "0x4"}, 2}}) {
    EXPECT_EQ(start(arguments).wait(), code) << arguments.back();
    const std::string said = read_text(file("errors"));
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  }
}

using NoDisplayTest = ProgramTest;
TEST_F(NoDisplayTest, WithoutADisplayTheViewerSaysSo) {
  unsetenv("WAYLAND_DISPLAY");
  Child window({std::string(PENUMBRA_BIN) + "/penumbra-viewer", kCube}, ":999999", path("errors"));
  EXPECT_EQ(window.wait(), 1);
  const std::string said = read_text(file("errors"));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_NE(said.find("display"), std::string::npos) << said;
}

}  // namespace
}  // namespace penumbra::test
