// Undo, redo, and whether something would be lost.
#include "apps/viewer/state/document.h"

#include <gtest/gtest.h>

#include "apps/viewer/state/state_commands.h"
#include "tests/apps/viewer/scenes.h"

namespace penumbra::viewer {
namespace {

/// Everything that undo restores.
void expect_same(const State& a, const State& b) {
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.selected, b.selected);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.left.method, b.left.method);
  EXPECT_EQ(a.left.options, b.left.options);
  EXPECT_EQ(a.right.method, b.right.method);
  EXPECT_EQ(a.right.options, b.right.options);
  EXPECT_EQ(a.arrangement, b.arrangement);
  EXPECT_EQ(a.shown, b.shown);
  EXPECT_EQ(a.exposure, b.exposure);
  EXPECT_EQ(a.divider, b.divider);
  EXPECT_EQ(a.difference_scale, b.difference_scale);
  EXPECT_EQ(a.overlays, b.overlays);
  EXPECT_EQ(a.probe, b.probe);
  EXPECT_EQ(a.aim, b.aim);
}

void move_light(Document& document, double by) {
  HandledLight light = document.state().handled();
  light.disk.center.x += by;
  light.disk.radius *= 1.1;
  document.state().set_handled(light);
}

TEST(Document, UndoAndRedoRestoreEachStateExactly) {
  Document document = document_of("meshes/bunny.ply");
  std::vector<State> states{document.state()};
  const auto step = [&](auto change) {
    change(document.state());
    document.note();
    states.push_back(document.state());
  };
  step([&](State&) { move_light(document, 0.1); });
  step([](State& s) { s.left.method = "dbuffer"; });
  step([](State& s) { s.left.options["dbuffer-size"] = std::uint64_t{64}; });
  step([](State& s) { change_state(s, Command::kViewTop); });
  step([](State& s) { change_state(s, Command::kUmbraSolid); });
  step([](State& s) { s.overlays.cut = 0.3; });
  step([](State& s) { s.exposure = 1.5; });
  step([](State& s) { s.arrangement = Arrangement::kSplit; });
  step([](State& s) { change_state(s, Command::kReset); });
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    ASSERT_TRUE(document.can_undo()) << i;
    document.undo();
    document.note();
    expect_same(document.state(), states[i]);
  }
  EXPECT_FALSE(document.can_undo());
  EXPECT_EQ(document.undo(), "nothing to undo");
  for (std::size_t i = 1; i < states.size(); ++i) {
    ASSERT_TRUE(document.can_redo()) << i;
    document.redo();
    document.note();
    expect_same(document.state(), states[i]);
  }
  EXPECT_FALSE(document.can_redo());
}

TEST(Document, UndoKeepsTheWindowsSizeAndMakesANewPicture) {
  Document document = document_of("scenes/cube-medium.json");
  move_light(document, 0.1);
  document.note();
  document.state().left.width = document.state().right.width = 333;
  const int revision = document.state().revision;
  EXPECT_EQ(document.undo(), "undone: light");
  EXPECT_EQ(document.state().left.width, 333);
  EXPECT_GT(document.state().revision, revision);
}

TEST(Document, CameraMovementsThatFollowOneAnotherAreOneStep) {
  Document document = document_of("scenes/cube-medium.json");
  const Camera before = document.state().camera;
  for (const Command each : {Command::kViewTop, Command::kViewFront, Command::kViewRight}) {
    change_state(document.state(), each);
    document.note();
  }
  EXPECT_EQ(document.undo(), "undone: camera");
  EXPECT_EQ(document.state().camera, before);
  EXPECT_FALSE(document.can_undo());
}

TEST(Document, WhatIsChangedAfterAnUndoTakesThePlaceOfWhatWasUndone) {
  Document document = document_of("scenes/cube-medium.json");
  move_light(document, 0.1);
  document.note();
  document.undo();
  change_state(document.state(), Command::kBand);
  document.note();
  EXPECT_FALSE(document.can_redo());
  EXPECT_EQ(document.undo(), "undone: overlays");
}

TEST(Document, OnlyTheOldestStepsAreForgotten) {
  Document document = document_of("scenes/cube-medium.json");
  for (int i = 0; i < 300; ++i) {
    move_light(document, 0.01);
    document.note();
  }
  const std::vector<Light> last = document.state().lights;
  int steps = 0;
  for (; document.can_undo(); ++steps) document.undo();
  EXPECT_EQ(steps, 199);
  for (; document.can_redo(); --steps) document.redo();
  EXPECT_EQ(document.state().lights, last);
}

TEST(Document, IsUnsavedWhileItsLightIsAnother) {
  Document document = document_of("scenes/cube-medium.json");
  EXPECT_FALSE(document.unsaved());
  change_state(document.state(), Command::kViewTop);
  change_state(document.state(), Command::kBand);
  document.note();
  EXPECT_FALSE(document.unsaved()) << "where one looks from is not asked about";
  move_light(document, 0.1);
  document.note();
  EXPECT_TRUE(document.unsaved());
  document.undo();
  EXPECT_FALSE(document.unsaved());
  document.redo();
  document.note_saved();
  EXPECT_FALSE(document.unsaved());
  document.undo();
  EXPECT_TRUE(document.unsaved());
}

}  // namespace
}  // namespace penumbra::viewer
