#include "apps/viewer/dialogs/start_screen.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "apps/viewer/panel/status_line.h"

namespace penumbra::viewer {
namespace {

void centered(const char* text) {
  ImGui::SetCursorPosX(0.5f * (ImGui::GetWindowWidth() - ImGui::CalcTextSize(text).x));
  ImGui::TextUnformatted(text);
}

}  // namespace

void StartScreen::read_keys(Choice& choice) {
  for (const Window::Key& key : window_.take_keys()) {
    if (key.key == GLFW_KEY_O && key.control) browser_.show({});
    if (key.key != GLFW_KEY_ESCAPE) continue;
    if (!browser_.shown()) choice.leave = true;
    browser_.hide();
  }
}

// Whether the button was pressed.
bool StartScreen::draw_middle(const std::string& message) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float font = ImGui::GetFontSize(), status = static_cast<float>(window_.look().status_height());
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({size.x, std::max(1.0f, size.y - status)});
  ImGui::Begin("start", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::SetCursorPosY(std::max(font, 0.5f * size.y - 7.0f * font));
  ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[Window::kTitleFont]);
  centered("Penumbra");
  ImGui::PopFont();
  ImGui::Spacing();
  centered("Soft shadows of a light that is moved by hand");
  ImGui::Dummy({0.0f, font});
  constexpr const char* kOpen = "Open a mesh or a scene...";
  const float width = ImGui::CalcTextSize(kOpen).x + 3.0f * font;
  ImGui::SetCursorPosX(0.5f * (size.x - width));
  const bool pressed = ImGui::Button(kOpen, {width, 2.4f * font});
  note_place(places_, "Open a file");
  ImGui::Spacing();
  centered("Ctrl+O, or drop a file here");
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  centered("OBJ, PLY, OFF, STL, or a scene file (.json)");
  ImGui::PopStyleColor();
  ImGui::End();
  draw_status_line({.message = message,
                    .activity = "Esc leaves",
                    .y = static_cast<int>(size.y - status),
                    .width = static_cast<int>(size.x),
                    .height = static_cast<int>(status)});
  return pressed;
}

StartScreen::Choice StartScreen::draw(const std::string& message) {
  Choice choice;
  places_.clear();
  for (const std::string& dropped : window_.take_dropped()) choice.file = dropped;
  read_keys(choice);
  if (draw_middle(message)) browser_.show({});
  if (const auto chosen = browser_.draw(places_)) choice.file = *chosen;
  return choice;
}

}  // namespace penumbra::viewer
