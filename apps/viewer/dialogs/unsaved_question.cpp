#include "apps/viewer/dialogs/unsaved_question.h"

#include <string>
#include <utility>

namespace penumbra::viewer {
namespace {

constexpr const char* kTitle = "The light was changed and is not saved";

}  // namespace

void UnsavedQuestion::ask(const std::optional<std::filesystem::path>& then) {
  shown_ = appears_ = true;
  closing_ = false;
  then_ = then;
}

std::optional<UnsavedQuestion::Answer> UnsavedQuestion::draw(Places& places) {
  if (!shown_) return std::nullopt;
  if (std::exchange(appears_, false)) ImGui::OpenPopup(kTitle);
  const DialogStyle style;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * window.x, 0.4f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(
          kTitle, nullptr,
          ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
    shown_ = closing_ = false;
    return std::nullopt;
  }
  std::optional<Answer> answer;
  const std::string what = then_ ? "opening " + then_->filename().string() : "leaving";
  ImGui::Text("Save it as a new scene file before %s?", what.c_str());
  ImGui::Spacing();
  if (button(places, "Save")) answer = Answer::kSave;
  ImGui::SameLine();
  if (button(places, "Don't save")) answer = Answer::kDiscard;
  ImGui::SameLine();
  if (button(places, "Stay (Esc)")) answer = Answer::kStay;
  if (answer || closing_) {
    shown_ = closing_ = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  return answer;
}

}  // namespace penumbra::viewer
