#include "apps/viewer/panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "apps/viewer/light_panel.h"
#include "apps/viewer/state/method_settings.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

// One setting as a combo or a number; its schema decides whether a value is accepted.
void setting_widget(RenderOptions& options, const OptionSchema& option, int& revision) {
  std::string value = value_of(options, option);
  const std::vector<std::string> choices = choices_of(option);
  const bool changed =
      choices.empty() ? ImGui::InputText(option.name.c_str(), &value, ImGuiInputTextFlags_EnterReturnsTrue)
                      : combo(option.name.c_str(), value, choices);
  help_on_hover(option.help + " (" + option.allowed() + (choices.empty() ? "; Enter applies)" : ")"));
  if (!changed) return;
  try {
    set(options, option.name, value);
    ++revision;
  } catch (const UsageError&) {  // the field shows the old value again
  }
}

void method_widgets(const char* label, RenderOptions& options, int& revision, Places& places) {
  ImGui::PushID(label);
  std::vector<std::string> names;
  for (const MethodInfo& method : methods()) names.push_back(method.name);
  std::string method = options.method;
  const bool changed = combo(label, method, names);
  note_place(places, label);
  help_on_hover(method_named(options.method).summary);
  if (changed) {
    options.method = method;
    ++revision;
  }
  for (const OptionSchema& option : method_named(options.method).options)
    setting_widget(options, option, revision);
  ImGui::PopID();
}

void shown_widgets(State& state, Places& places) {
  int shown = static_cast<int>(state.shown);
  constexpr const char* kNames[] = {"picture", "visibility", "certified"};
  constexpr const char* kHelp[] = {
      "colors", "the fraction of the disk that is seen, black to white",
      "by the methods silhouette and rays: yellow lit, orange partial, blue umbra, gray not certified"};
  for (int i = 0; i < 3; ++i) {
    if (i) ImGui::SameLine();
    ImGui::RadioButton(kNames[i], &shown, i);
    note_place(places, std::string("show ") + kNames[i]);
    help_on_hover(kHelp[i]);
  }
  state.shown = static_cast<Shown>(shown);
}

void methods_section(State& state, Places& places) {
  if (!ImGui::CollapsingHeader("Method", ImGuiTreeNodeFlags_DefaultOpen)) return;
  int arrangement = static_cast<int>(state.arrangement);
  constexpr const char* kNames[] = {"one", "split", "difference"};
  for (int i = 0; i < 3; ++i) {
    if (i) ImGui::SameLine();
    ImGui::RadioButton(kNames[i], &arrangement, i);
    note_place(places, kNames[i]);
  }
  state.arrangement = static_cast<Arrangement>(arrangement);
  method_widgets("method", state.left, state.revision, places);
  if (state.two_sided()) {
    ImGui::Separator();
    method_widgets("against", state.right, state.revision, places);
  }
  if (state.arrangement == Arrangement::kDifference)
    slider(places, "scale", state.difference_scale, 0.005, 1.0, "+-%.3f visibility",
           ImGuiSliderFlags_Logarithmic);
  if (state.arrangement != Arrangement::kDifference) shown_widgets(state, places);
  slider(places, "exposure", state.exposure, -6.0, 6.0, "%+.1f stops");
}

void overlay_box(const char* label, Command command, bool& flag, Places& places) {
  ImGui::Checkbox(label, &flag);
  note_place(places, label);
  help_on_hover(std::string(key_of(command).help) + " (" + key_of(command).shown + ")");
}

void cut_widgets(Overlays& o, Places& places) {
  slider(places, "cut", o.cut, 0.0, 1.0, "%.2f of the way");
  int axis = static_cast<int>(o.cut_axis);
  constexpr const char* kNames[] = {"along the light", "along x", "along y", "along z"};
  for (int i = 0; i < 4; ++i) {
    if (i % 2) ImGui::SameLine(150);
    ImGui::RadioButton(kNames[i], &axis, i);
    note_place(places, kNames[i]);
  }
  o.cut_axis = static_cast<CutAxis>(axis);
}

void overlays_section(State& state, Places& places) {
  if (!ImGui::CollapsingHeader("Geometry", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Overlays& o = state.overlays;
  overlay_box("light", Command::kLightHandles, o.light, places);
  ImGui::SameLine(110);
  overlay_box("faces", Command::kFaces, o.faces, places);
  ImGui::SameLine(210);
  overlay_box("band", Command::kBand, o.band, places);
  overlay_box("silhouettes", Command::kSilhouettes, o.silhouettes, places);
  ImGui::SameLine(110);
  overlay_box("sheets", Command::kSheets, o.sheets, places);
  ImGui::SameLine(210);
  overlay_box("probe", Command::kProbe, state.probe, places);
  overlay_box("penumbra", Command::kPenumbraVolume, o.penumbra, places);
  ImGui::SameLine(110);
  overlay_box("umbra", Command::kUmbraVolume, o.umbra, places);
  ImGui::SameLine(210);
  ImGui::Checkbox("textures", &o.textures);
  note_place(places, "textures");
  help_on_hover("what the D-buffer or the occlusion textures hold, as the light sees it");
  if (o.sheets || o.penumbra || o.umbra) cut_widgets(o, places);
}

void stage_bars(const RenderResult& result) {
  double longest = 1e-9;
  for (const StageTime& stage : result.stages) longest = std::max(longest, stage.milliseconds);
  for (const StageTime& stage : result.stages) {
    char text[64];
    std::snprintf(text, sizeof text, "%.1f ms", stage.milliseconds);
    ImGui::ProgressBar(static_cast<float>(stage.milliseconds / longest), {150.0f, 13.0f}, text);
    ImGui::SameLine();
    ImGui::TextUnformatted(stage.name.c_str());
  }
}

void side_costs(const Side& side) {
  const RenderResult& result = *side.result;
  ImGui::Text("%s %dx%d: %.1f ms", side.options.method.c_str(), result.image.width, result.image.height,
              result.frame_ms);
  stage_bars(result);
  std::string counts;
  for (const MethodFrame& frame : result.lights)
    for (const Count& count : frame.counts)
      counts += (counts.empty() ? "" : ", ") + count.name + " " + to_text(count.value);
  ImGui::TextWrapped("%s", counts.c_str());
}

void costs_section(const PanelInput& input) {
  if (!ImGui::CollapsingHeader("Cost", ImGuiTreeNodeFlags_DefaultOpen) || !input.frame) return;
  ImGui::PushID("costs");
  ImGui::Text("%d pictures in the last second; %.0f MiB", input.costs->per_second(),
              static_cast<double>(resident_bytes()) / (1 << 20));
  const std::vector<float>& history = input.costs->history();
  ImGui::PlotHistogram("ms", history.data(), static_cast<int>(history.size()), 0, nullptr, 0.0f, FLT_MAX,
                       {220, 36});
  for (const Side& side : input.frame->sides) side_costs(side);
  ImGui::PopID();
}

void picture_status(const PanelInput& input) {
  if (!input.frame) return ImGui::TextUnformatted("rendering the first picture");
  const Frame& frame = *input.frame;
  if (!frame.trouble.empty()) return ImGui::TextWrapped("no picture: %s", frame.trouble.c_str());
  if (!input.settled && !frame.final && frame.reduction > 1)
    ImGui::Text("draft, 1/%d of the pixels a side", frame.reduction);
  else
    ImGui::TextUnformatted(input.settled ? "final picture" : "draft");
  for (const Side& side : frame.sides)
    if (side.rays) ImGui::Text("reference: %d rays a pixel%s", side.rays, frame.refining ? ", refining" : "");
  if (frame.error)
    ImGui::Text("error over penumbra: RMSE %.4f, max %.3f", frame.error->rmse, frame.error->max_absolute);
}

std::optional<Command> buttons() {
  constexpr Command kButtons[] = {Command::kSavePicture,   Command::kSaveState,      Command::kCopyCommand,
                                  Command::kExportVolumes, Command::kExportSequence, Command::kHelp};
  constexpr const char* kLabels[] = {"picture", "state", "command", "volumes", "sequence", "help"};
  std::optional<Command> pressed;
  for (std::size_t i = 0; i < std::size(kButtons); ++i) {
    if (i % 3) ImGui::SameLine();
    if (ImGui::Button(kLabels[i], {95.0f, 0.0f})) pressed = kButtons[i];
    help_on_hover(std::string(key_of(kButtons[i]).help) + " (" + key_of(kButtons[i]).shown + ")");
  }
  return pressed;
}

}  // namespace

std::optional<Command> Panel::draw(State& state, const PanelInput& input) {
  places_.clear();
  ImGui::SetNextWindowPos({static_cast<float>(input.x), 0.0f});
  ImGui::SetNextWindowSize({static_cast<float>(kPanelWidth), static_cast<float>(input.height)});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::PushItemWidth(158.0f);
  std::size_t faces = 0;
  for (const SceneObject& object : state.model->objects) faces += object.mesh.triangles().size();
  ImGui::Text("%s: %zu faces", state.path.filename().c_str(), faces);
  picture_status(input);
  const std::optional<Command> pressed = buttons();
  if (!input.message.empty()) ImGui::TextWrapped("%s", input.message.c_str());
  methods_section(state, places_);
  light_section(state, places_);
  overlays_section(state, places_);
  costs_section(input);
  ImGui::PopItemWidth();
  ImGui::End();
  return pressed;
}

}  // namespace penumbra::viewer
