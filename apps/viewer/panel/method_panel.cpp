#include "apps/viewer/panel/method_panel.h"

#include <imgui_stdlib.h>

#include <algorithm>

#include "apps/viewer/panel/words.h"
#include "apps/viewer/state/method_settings.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

// One setting as a choice or a number; its schema decides whether a value is accepted.
void setting_widget(RenderOptions& options, const OptionSchema& option, int& revision, Places& places) {
  const std::string label = words_of_option(option.name);
  std::string value = shown_value(option, value_of(options, option));
  const std::vector<std::string> choices = choices_of(option);
  bool changed = false;
  if (choices.empty()) {
    label_of_next(label.c_str());
    changed = ImGui::InputText(("##" + option.name).c_str(), &value, ImGuiInputTextFlags_EnterReturnsTrue);
    note_place(places, label);
  } else {
    const auto at = static_cast<std::size_t>(std::ranges::find(choices, value) - choices.begin());
    const std::size_t chosen = combo(places, label.c_str(), at, choices);
    changed = chosen != at;
    value = choices[chosen];
  }
  help_on_hover(help_of(option) + (choices.empty() ? " Enter applies it." : "") +
                "\nOn the command line: --" + option.name);
  if (!changed) return;
  try {
    set(options, option.name, value_from_shown(option, value));
    ++revision;
  } catch (const UsageError&) {  // the field shows the old value again
  }
}

void method_widgets(const char* label, RenderOptions& options, int& revision, Places& places) {
  ImGui::PushID(label);
  std::vector<std::string> names, help;
  std::size_t at = 0;
  for (const MethodInfo& method : methods()) {
    if (method.name == options.method) at = names.size();
    names.push_back(words_of_method(method.name));
    help.push_back(names.back() + ": " + method.summary + "\nOn the command line: --method " + method.name);
  }
  const std::size_t chosen = combo(places, label, at, names, help);
  if (chosen != at) {
    options.method = methods()[chosen].name;
    ++revision;
  }
  const MethodInfo& method = method_named(options.method);
  const std::string heading = "Options of " + words_of_method(method.name);
  if (!method.options.empty()) {
    const bool open = ImGui::TreeNodeEx(heading.c_str(), ImGuiTreeNodeFlags_NoTreePushOnOpen);
    note_place(places, heading);
    if (open) {
      ImGui::Indent(0.6f * ImGui::GetFontSize());
      for (const OptionSchema& option : method.options) setting_widget(options, option, revision, places);
      ImGui::Unindent(0.6f * ImGui::GetFontSize());
    }
  }
  ImGui::PopID();
}

}  // namespace

void picture_section(State& state, Places& places) {
  if (!ImGui::CollapsingHeader("Picture", ImGuiTreeNodeFlags_DefaultOpen)) return;
  int arrangement = static_cast<int>(state.arrangement);
  radio_line(places, arrangement, {"One", "Divided", "Difference"},
             {"One method", "Two methods, with a divider to drag", "The first method minus the second"});
  state.arrangement = static_cast<Arrangement>(arrangement);
  method_widgets("Method", state.left, state.revision, places);
  if (state.two_sided()) method_widgets("Against", state.right, state.revision, places);
  if (state.arrangement == Arrangement::kDifference) {
    slider(places, "Scale", state.difference_scale, 0.005, 1.0, "± %.3f visibility",
           ImGuiSliderFlags_Logarithmic);
  } else {
    int shown = static_cast<int>(state.shown);
    radio_line(places, shown, {"Colors", "Visibility", "Certified"},
               {"Colors as the light makes them",
                "The part of the light that each point sees: black none, white all",
                "What the method proves: lit or in umbra (Silhouette, Rays where uncertain)"});
    state.shown = static_cast<Shown>(shown);
  }
  slider(places, "Exposure", state.exposure, -6.0, 6.0, "%+.1f stops");
}

}  // namespace penumbra::viewer
