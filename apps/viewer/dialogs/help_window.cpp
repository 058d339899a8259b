#include "apps/viewer/dialogs/help_window.h"

#include <imgui.h>

#include "apps/viewer/commands.h"

namespace penumbra::viewer {
namespace {

struct Row {
  const char *what, *does;
};
constexpr Row kMouse[] = {{"Left drag", "Turns"},
                          {"Middle or Shift drag", "Pans"},
                          {"Wheel", "Zooms to the pointer"},
                          {"Double click", "Looks at that point"},
                          {"Drag the light's arrows", "Moves it along an axis"},
                          {"Drag the light's center", "Moves it; turns a distant light"},
                          {"Drag the tip of its normal", "Tilts it"},
                          {"Drag its rim", "Changes its radius, or its angle"},
                          {"Drop a file", "Opens it"}};

void row(const char* what, const char* does) {
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(does);
}

}  // namespace

void draw_help(bool& shown) {
  const float font = ImGui::GetFontSize();
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({font, font}, ImGuiCond_Appearing);
  ImGui::SetNextWindowSize({56.0f * font, 0.0f});
  ImGui::SetNextWindowSizeConstraints({10.0f * font, 5.0f * font}, {window.x, window.y - 2.0f * font});
  ImGui::Begin("Mouse and keys", &shown, ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::BeginTable("help", 4)) {
    for (const float width : {9.5f, 15.0f, 9.5f, 15.0f})
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, width);
    for (const Row& each : kMouse) row(each.what, each.does);
    for (const CommandKey& each : command_keys())
      if (&each == &key_of(each.command)) row(each.shown, each.label);
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace penumbra::viewer
