#include "apps/viewer/panel/widgets.h"

namespace penumbra::viewer {

void note_place(Places& places, const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places[name] = {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
}

void help_on_hover(const std::string& text) {
  if (!ImGui::IsItemHovered() || text.empty()) return;
  // Beside the window, so that it hides no other widget.
  const float font = ImGui::GetFontSize(), left = ImGui::GetWindowPos().x;
  if (left > 23.0f * font)
    ImGui::SetNextWindowPos({left - 0.4f * font, ImGui::GetItemRectMin().y}, ImGuiCond_Always, {1.0f, 0.0f});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(21.0f * font);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void label_of_next(const char* label) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  ImGui::SameLine(8.1f * ImGui::GetFontSize());
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
                  const std::vector<std::string>& texts, const std::vector<std::string>& help) {
  label_of_next(label);
  const std::string id = std::string("##") + label;
  const bool open = ImGui::BeginCombo(id.c_str(), texts[chosen].c_str());
  note_place(places, label);
  if (!open) return chosen;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (ImGui::Selectable(texts[i].c_str(), i == chosen)) chosen = i;
    note_place(places, texts[i]);
    if (i < help.size()) help_on_hover(help[i]);
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

DialogStyle::DialogStyle() {
  const float font = ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {1.0f * font, 0.9f * font});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.8f * font, 0.35f * font});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.6f * font, 0.5f * font});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
}

DialogStyle::~DialogStyle() {
  ImGui::PopStyleVar(4);
}

}  // namespace penumbra::viewer
