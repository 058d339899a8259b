#include "apps/viewer/widgets.h"

namespace penumbra::viewer {

void note_place(Places& places, const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places[name] = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
}

void help_on_hover(const std::string& text) {
  if (!ImGui::IsItemHovered() || text.empty()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(320.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool slider(Places& places, const char* label, double& value, double low, double high, const char* format,
            ImGuiSliderFlags flags) {
  const bool changed = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                                           flags | ImGuiSliderFlags_AlwaysClamp);
  note_place(places, label);
  return changed;
}

bool combo(const char* label, std::string& value, const std::vector<std::string>& words) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, value.c_str())) return false;
  for (const std::string& word : words)
    if (ImGui::Selectable(word.c_str(), word == value)) {
      value = word;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

}  // namespace penumbra::viewer
