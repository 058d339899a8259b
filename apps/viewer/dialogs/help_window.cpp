#include "apps/viewer/dialogs/help_window.h"

#include <algorithm>

#include "apps/viewer/commands.h"
#include "apps/viewer/panel/widgets.h"

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

// Two pairs of columns: the widths of what is done and of what it does.
bool begin_pairs(const char* name, float what, float does) {
  if (!ImGui::BeginTable(name, 4)) return false;
  for (const float width : {what, does, what, does})
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, width);
  return true;
}

}  // namespace

void draw_help(bool& shown) {
  const DialogStyle style;
  const float font = ImGui::GetFontSize();
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({font, 2.6f * font}, ImGuiCond_Appearing);
  ImGui::SetNextWindowSize({std::min(60.0f * font, window.x - 2.0f * font), 0.0f});
  ImGui::SetNextWindowSizeConstraints({10.0f * font, 5.0f * font}, {window.x, window.y - 4.0f * font});
  ImGui::Begin("Mouse and keys", &shown,
               ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoScrollbar);
  if (begin_pairs("mouse", 12.0f, 16.0f)) {
    for (const Row& each : kMouse) row(each.what, each.does);
    ImGui::EndTable();
  }
  ImGui::Separator();
  if (begin_pairs("keys", 7.0f, 21.0f)) {
    for (const CommandKey& each : command_keys())
      if (&each == &key_of(each.command)) row(each.shown, each.label);
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace penumbra::viewer
