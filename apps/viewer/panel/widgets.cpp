#include "apps/viewer/panel/widgets.h"

namespace penumbra::viewer {

void note_place(Places& places, const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places[name] = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
}

void help_on_hover(const std::string& text) {
  if (!ImGui::IsItemHovered() || text.empty()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(21.0f * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void label_of_next(const char* label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(7.6f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1.0f);
}

bool slider(Places& places, const char* label, double& value, double low, double high, const char* format,
            ImGuiSliderFlags flags) {
  label_of_next(label);
  const std::string id = std::string("##") + label;
  const bool changed = ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &low, &high, format,
                                           flags | ImGuiSliderFlags_AlwaysClamp);
  note_place(places, label);
  return changed;
}

std::size_t combo(Places& places, const char* label, std::size_t chosen,
                  const std::vector<std::string>& texts) {
  label_of_next(label);
  const std::string id = std::string("##") + label;
  const bool open = ImGui::BeginCombo(id.c_str(), texts[chosen].c_str());
  note_place(places, label);
  if (!open) return chosen;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (ImGui::Selectable(texts[i].c_str(), i == chosen)) chosen = i;
    note_place(places, texts[i]);
  }
  ImGui::EndCombo();
  return chosen;
}

bool radio_line(Places& places, int& chosen, const std::vector<const char*>& texts,
                const std::vector<const char*>& help) {
  const int before = chosen;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i) ImGui::SameLine();
    ImGui::RadioButton(texts[i], &chosen, static_cast<int>(i));
    note_place(places, texts[i]);
    if (i < help.size()) help_on_hover(help[i]);
  }
  return chosen != before;
}

bool button(Places& places, const char* label) {
  const bool pressed = ImGui::Button(label);
  note_place(places, label);
  return pressed;
}

}  // namespace penumbra::viewer
