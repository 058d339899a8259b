// Words that the window shows: of methods and options, legends, the status line.
#include "apps/viewer/panel/words.h"

#include <gtest/gtest.h>

#include "apps/viewer/dialogs/file_browser.h"
#include "apps/viewer/panel/status_line.h"
#include "apps/viewer/pictures/legend.h"
#include "apps/viewer/state/method_settings.h"

namespace penumbra::viewer {
namespace {

TEST(Words, OfEveryMethodAndOptionAreNoInternalNames) {
  register_drawing_methods();
  for (const MethodInfo& method : methods()) {
    EXPECT_NE(words_of_method(method.name), method.name);
    for (const OptionSchema& option : method.options) {
      const std::string words = words_of_option(option.name);
      EXPECT_NE(words, option.name);
      EXPECT_EQ(words.find('-'), std::string::npos) << words;
      EXPECT_TRUE(words[0] >= 'A' && words[0] <= 'Z') << words;
    }
  }
  EXPECT_EQ(words_of_method("my-own"), "My own");
}

TEST(Words, AZeroWithAMeaningOfItsOwnIsAuto) {
  register_drawing_methods();
  int autos = 0;
  for (const OptionSchema& option : all_options()) {
    const std::string usual = to_text(option.usual), shown = shown_value(option, usual);
    EXPECT_EQ(value_from_shown(option, shown), usual);
    if (shown == usual) continue;
    ++autos;
    EXPECT_EQ(shown, "auto") << option.name;
    EXPECT_EQ(help_of(option).find(" 0"), std::string::npos) << help_of(option);
  }
  EXPECT_GE(autos, 1) << "dbuffer-size";
}

TEST(Words, SilhouetteIsTheFirstMethod) {
  EXPECT_EQ(methods().front().name, "silhouette");
}

TEST(Words, NumbersHaveCommas) {
  EXPECT_EQ(with_commas(7), "7");
  EXPECT_EQ(with_commas(999), "999");
  EXPECT_EQ(with_commas(1000), "1,000");
  EXPECT_EQ(with_commas(12345678), "12,345,678");
}

TEST(Legend, NamesTheColorsOfEveryOverlayThatHasSome) {
  EXPECT_TRUE(legend_of({}).empty());
  for (const auto& [name, flag] : kOverlayFlags) {
    State state;
    state.overlays.*flag = true;
    const bool colored = std::string(name) != "light" && std::string(name) != "textures";
    EXPECT_EQ(!legend_of(state).empty(), colored) << name;
  }
  State state;
  state.shown = Shown::kRegion;
  EXPECT_EQ(legend_of(state).size(), 4u);
  state.arrangement = Arrangement::kDifference;
  EXPECT_TRUE(legend_of(state).empty()) << "it has a scale of its own";
}

TEST(StatusLine, TellsWhatThePictureIs) {
  EXPECT_EQ(picture_in_words(nullptr, false), "making the first picture");
  Frame frame;
  EXPECT_EQ(picture_in_words(&frame, false), "full size") << "while something moves";
  EXPECT_EQ(picture_in_words(&frame, true), "final picture");
  frame.sides.push_back({.result = nullptr, .options = {}, .rays = 4096});
  frame.refining = true;
  EXPECT_EQ(picture_in_words(&frame, true), "final picture, 4,096 rays a pixel, refining");
  RenderResult small;
  small.image.width = 480;
  small.image.height = 300;
  frame.sides = {{.result = std::make_shared<const RenderResult>(std::move(small)), .options = {}}};
  frame.reduction = 2;
  EXPECT_EQ(picture_in_words(&frame, false), "draft of 480 × 300, 1/2 of full size");
}

TEST(FileBrowser, ShowsScenesAndMeshes) {
  for (const char* name : {"a.json", "a.obj", "b.PLY", "c.off", "d.Stl"})
    EXPECT_TRUE(can_be_opened(name)) << name;
  for (const char* name : {"a.png", "a", "ply", "a.json.txt", ".ply"})
    EXPECT_FALSE(can_be_opened(name)) << name;
}

}  // namespace
}  // namespace penumbra::viewer
