// The real window under Xvfb: opening, undoing, leaving, and solids.
#include <stb_image.h>

#include <fstream>

#include "tests/apps/viewer/window_driver.h"

namespace penumbra::test {
namespace {

const std::string kCube = PENUMBRA_DATA "/scenes/cube-medium.json";
const std::string kTorus = PENUMBRA_DATA "/scenes/torus-medium.json";

class WorkTest : public WindowTest {
 protected:
  void click(const Json& at) const {
    const auto pixel = [](const Json& value) {
      return std::to_string(static_cast<int>(value.get<double>() + 0.5));
    };
    tool("mousemove " + pixel(at[0]) + " " + pixel(at[1]));
    std::this_thread::sleep_for(
        std::chrono::milliseconds(100));  // ImGui opens nothing that the mouse jumped to
    tool("click 1");
  }
  /// A dialog has its place from its second frame on: it is clicked where two looks agree.
  void click_widget(const std::string& name) {
    Json last;
    const Json now = until("the widget " + name, [&](const Json& s) {
      if (!s.contains("widgets") || !s["widgets"].contains(name)) return false;
      const bool rests = s["widgets"][name] == last;
      last = s["widgets"][name];
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      return rests;
    });
    click(now["widgets"][name]);
  }
  /// Moves the light by its center. The state from before.
  Json move_light(int x = 20) {
    const Json before = status();
    drag(before["handles"]["center"], x, 5, "another place",
         [&](const Json& s) { return s["light"]["center"] != before["light"]["center"]; });
    return before;
  }
  void expect_dialog(const std::string& name) {
    until("the dialog '" + name + "'", [&](const Json& s) { return s["dialog"] == name; });
  }
};

TEST_F(WorkTest, StartsWithItsLightInView) {
  open({PENUMBRA_DATA "/meshes/bunny.ply", "--size", "320x200"});
  const Json center = status()["handles"]["center"];
  EXPECT_GT(center[0], 0.0);
  EXPECT_GT(center[1], 0.0);
  EXPECT_LT(center[0], 320.0);
  EXPECT_LT(center[1], 200.0);
}

TEST_F(WorkTest, UndoAndRedoByKeys) {
  open({kCube, "--size", "480x400"});
  const Json before = move_light(), after = status();
  EXPECT_EQ(after["can_undo"], true);
  EXPECT_EQ(after["unsaved"], true);
  key("b");
  until("the band", [](const Json& s) { return s["overlays"] == Json({"light", "band"}); });
  key("ctrl+z");
  until("the band gone", [](const Json& s) { return s["overlays"] == Json({"light"}); });
  key("ctrl+z");
  const Json undone = settled("the light back", [&](const Json& s) { return s["light"] == before["light"]; });
  EXPECT_EQ(undone["message"], "undone: light");
  EXPECT_EQ(undone["camera"], before["camera"]);
  EXPECT_EQ(undone["unsaved"], false);
  EXPECT_EQ(undone["can_undo"], false);
  key("ctrl+shift+z");
  settled("the light again", [&](const Json& s) { return s["light"] == after["light"]; });
  key("ctrl+y");
  settled("the band again", [](const Json& s) { return s["overlays"] == Json({"light", "band"}); });
}

TEST_F(WorkTest, ALightThatIsDraggedTurnsToWhatItShoneAtUnlessToldOtherwise) {
  open({kCube, "--size", "480x680"});
  const Json before = move_light();
  EXPECT_NE(status()["light"]["normal"], before["light"]["normal"]);
  key("ctrl+z");
  settled("the light back", [&](const Json& s) { return s["light"] == before["light"]; });
  click_widget("Aim");
  until("a step to undo", [](const Json& s) { return s["can_undo"] == true; });
  move_light();
  EXPECT_EQ(status()["light"]["normal"], before["light"]["normal"]);
}

// On a busy machine not at once: full size is tried again after some drafts.
TEST_F(WorkTest, ALightIsDraggedAtFullSizeWhereThatKeepsUp) {
  open({kCube, "--size", "480x400"});
  const Json before = status();
  int step = 5;
  drag(before["handles"]["center"], 20, 5, "a picture of full size meanwhile", [&](const Json& s) {
    tool("mousemove_relative -- " + std::to_string(step = -step) + " 0");
    return s["light"]["center"] != before["light"]["center"] && s["frame"]["final"] == false &&
           s["frame"]["reduction"] == 1;
  });
}

TEST_F(WorkTest, EscapeEndsADragAndTakesItBack) {
  open({kCube, "--size", "480x400"});
  const Json before = status();
  const Json at = before["handles"]["center"];
  tool("mousemove " + std::to_string(at[0].get<int>()) + " " + std::to_string(at[1].get<int>()) +
       " mousedown 1");
  until("the drag's start", [](const Json& s) { return s["holding"] == true; });
  tool("mousemove_relative 30 10");
  until("another place", [&](const Json& s) { return s["light"]["center"] != before["light"]["center"]; });
  key("Escape");
  settled("the light back", [&](const Json& s) { return s["light"] == before["light"]; });
  tool("mouseup 1");
  EXPECT_EQ(status()["can_undo"], false);
}

// The usual detail of a torus takes many seconds.
TEST_F(WorkTest, EscapeGivesUpAnExportAndThenLeaves) {
  open({kTorus, "--size", "320x200"});
  key("ctrl+e");
  until("the export", [](const Json& s) {
    return s["activity"].get<std::string>().starts_with("exporting umbra and penumbra");
  });
  key("Escape");
  until("its end", [](const Json& s) { return s["message"] == "given up: umbra and penumbra"; });
  EXPECT_FALSE(std::filesystem::exists(file("torus-medium-001-umbra.ply")));
  key("Escape");
  EXPECT_EQ(wait_for_end(), 0);
}

TEST_F(WorkTest, EscapeAsksBeforeAChangedLightIsLost) {
  open({kCube, "--size", "480x400"});
  const Json before = move_light(), moved = status();
  key("Escape");
  expect_dialog("unsaved");
  key("Escape");
  expect_dialog("");
  EXPECT_EQ(status()["light"], moved["light"]) << "it stays";
  key("Escape");
  expect_dialog("unsaved");
  click_widget("Save");
  EXPECT_EQ(wait_for_end(), 0);
  const Json saved = Json::parse(read_text(file("cube-medium-001.json")));
  EXPECT_EQ(saved["lights"][0]["center"], moved["light"]["center"]);
}

TEST_F(WorkTest, WhatIsSavedOrDiscardedIsNotAskedAbout) {
  open({kCube, "--size", "480x400"});
  move_light();
  key("ctrl+s");
  until("nothing unsaved", [](const Json& s) { return s["unsaved"] == false; });
  key("Escape");
  EXPECT_EQ(wait_for_end(), 0);
  open({kCube, "--size", "480x400"});
  move_light();
  key("Escape");
  expect_dialog("unsaved");
  click_widget("Don't save");
  EXPECT_EQ(wait_for_end(), 0);
  open({kCube, "--size", "480x400"});
  key("3");
  until("another view", [](const Json& s) { return s["can_undo"] == true; });
  key("Escape");
  EXPECT_EQ(wait_for_end(), 0) << "a camera is not asked about";
}

TEST_F(WorkTest, AnotherFileOpensOnceTheLightIsSavedOrGivenUp) {
  open({kCube, kTorus, "--size", "480x400"});
  move_light();
  key("Page_Down");
  expect_dialog("unsaved");
  EXPECT_EQ(status()["file"], kCube);
  click_widget("Don't save");
  const Json now = settled("the torus", [](const Json& s) { return s["file"] == kTorus; });
  EXPECT_EQ(now["unsaved"], false);
  EXPECT_EQ(now["can_undo"], false);
}

TEST_F(WorkTest, WithoutAFileItAsksForOne) {
  std::filesystem::copy_file(PENUMBRA_DATA "/meshes/bunny.ply", file("a.ply"));
  std::ofstream(file("b.ply")) << "ply\nformat ascii 1.0\nelement vertex many\n";
  std::filesystem::create_directory(file("inner"));
  std::filesystem::copy_file(kCube, file("inner/c.txt"));
  open_empty();
  click_widget("Open a file");
  click_widget("file b.ply");
  click_widget("Open");
  until("a message", [](const Json& s) { return !s["message"].get<std::string>().empty(); });
  EXPECT_EQ(status()["empty"], true);
  click_widget("Open a file");
  click_widget("file inner");
  until("the folder", [](const Json& s) { return !s["widgets"].contains("file a.ply"); });
  EXPECT_FALSE(status()["widgets"].contains("file c.txt"));
  click_widget("file ..");
  click_widget("file a.ply");
  click_widget("Open");
  settled("the mesh", [&](const Json& s) { return s.contains("file") && s["file"] == path("a.ply"); });
}

TEST_F(WorkTest, WithoutAFileEscapeLeaves) {
  open_empty();
  key("ctrl+o");
  until("the browser", [](const Json& s) { return s["widgets"].contains("Cancel"); });
  key("Escape");
  until("no browser", [](const Json& s) { return !s["widgets"].contains("Cancel"); });
  key("Escape");
  EXPECT_EQ(wait_for_end(), 0);
}

TEST_F(WorkTest, OpensAnotherFileFromTheBrowser) {
  std::filesystem::copy_file(PENUMBRA_DATA "/meshes/bunny.ply", file("first.ply"));
  std::filesystem::copy_file(PENUMBRA_DATA "/meshes/knot1.ply", file("second.ply"));
  open({path("first.ply"), "--size", "480x400"});
  key("ctrl+o");
  expect_dialog("open");
  click_widget("file second.ply");
  click_widget("Open");
  settled("the other file", [&](const Json& s) { return s["file"] == path("second.ply"); });
}

TEST_F(WorkTest, MessagesMoveNothing) {
  open({kCube, "--size", "480x680"});
  const Json before = status();
  key("ctrl+s");
  const Json after =
      until("the state saved", [&](const Json& s) { return s["message"] != before["message"]; });
  EXPECT_EQ(after["widgets"], before["widgets"]);
  EXPECT_EQ(after["picture"], before["picture"]);
}

TEST_F(WorkTest, SolidsAreRefinedAsTheyCome) {
  open({kCube, "--size", "480x680"});
  key("u");
  key("v");
  until("both solids, the finest", [](const Json& s) {
    return s["solid_detail"] == 0.02 && s["overlays"] == Json({"light", "penumbra-solid", "umbra-solid"});
  });
  move_light();
  until("those of the other light", [](const Json& s) { return s["solid_detail"] == 0.02; });
}

/// Pixels of the picture that are strongly orange.
int orange_pixels(const std::filesystem::path& path, int columns) {
  int width = 0, height = 0, channels = 0, count = 0;
  unsigned char* pixels = stbi_load(path.c_str(), &width, &height, &channels, 3);
  if (!pixels) return -1;
  for (int i = 0; i < width * height; ++i)
    if (i % width < columns && pixels[3 * i] > pixels[3 * i + 2] + 90) ++count;
  stbi_image_free(pixels);
  return count;
}

TEST_F(WorkTest, TheSectionOfACutSolidIsFilled) {
  int orange[2] = {};
  for (const bool cut : {false, true}) {
    Json document = Json::parse(read_text(kCube));
    for (Json& object : document["objects"])
      object["mesh"] = std::string(PENUMBRA_DATA "/scenes/") + object["mesh"].get<std::string>();
    document["x-viewer"] = {{"left", {{"method", "silhouette"}}},
                            {"right", {{"method", "reference"}}},
                            {"overlays", {{"penumbra-solid", true}}},
                            {"cut", cut ? 0.5 : 1.0},
                            {"cut_axis", "z"}};
    std::ofstream(file("s.json")) << document;
    Child window = start({path("s.json"), "--size", "400x300", "--screenshot", path("w.png")});
    ASSERT_EQ(window.wait(), 0) << read_text(file("errors"));
    orange[cut] = orange_pixels(file("w.png"), 400);
  }
  // The section through the axis covers about as much as half of the silhouette's; glass is strong at its rim
  // only.
  EXPECT_GT(orange[1], orange[0] + 3000) << orange[0];
}

TEST_F(WorkTest, TheSizeOfTheFontIsThatOfEverything) {
  open({kCube, "--size", "320x300", "--font-size", "30"});
  EXPECT_EQ(status()["picture"], Json({320, 300}));
  key("Tab");
  settled("no panel", [](const Json& s) { return s["picture"] == Json({320 + 660, 300}); });
}

}  // namespace
}  // namespace penumbra::test
