#include "apps/viewer/panel/overlay_panel.h"

#include "apps/viewer/commands.h"

namespace penumbra::viewer {
namespace {

void box(const char* label, Command command, bool& flag, Places& places, bool second = false) {
  if (second) ImGui::SameLine(11.0f * ImGui::GetFontSize());
  ImGui::Checkbox(label, &flag);
  note_place(places, label);
  help_on_hover(std::string(key_of(command).label) + "\nKey: " + key_of(command).shown);
}

void cut_widgets(Overlays& o, Places& places) {
  // They keep their place where nothing can be cut.
  ImGui::BeginDisabled(!o.can_be_cut());
  slider(places, "Cut", o.cut, 0.0, 1.0, o.cut < 1.0 ? "at %.2f of the way" : "not cut");
  int axis = static_cast<int>(o.cut_axis);
  label_of_next("along");
  radio_line(places, axis, {"light##cut", "x##cut", "y##cut", "z##cut"},
             {"The way of the light, from its plane to the far end of the scene", "The x axis", "The y axis",
              "The z axis"});
  o.cut_axis = static_cast<CutAxis>(axis);
  ImGui::EndDisabled();
}

}  // namespace

void overlay_section(State& state, Places& places) {
  if (!ImGui::CollapsingHeader("Overlays", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Overlays& o = state.overlays;
  box("Umbra", Command::kUmbraSolid, o.umbra_solid, places);
  box("Penumbra", Command::kPenumbraSolid, o.penumbra_solid, places, true);
  box("Umbra cells", Command::kUmbraCells, o.umbra, places);
  box("Penumbra cells", Command::kPenumbraCells, o.penumbra, places, true);
  box("Silhouettes", Command::kSilhouettes, o.silhouettes, places);
  box("Sheets", Command::kSheets, o.sheets, places, true);
  box("Faces", Command::kFaces, o.faces, places);
  box("Band of edges", Command::kBand, o.band, places, true);
  box("Light", Command::kLightHandles, o.light, places);
  box("Probe", Command::kProbe, state.probe, places, true);
  ImGui::Checkbox("Textures of D-buffer and occlusion textures", &o.textures);
  note_place(places, "Textures");
  help_on_hover("What these methods see from the light and keep in textures");
  ImGui::BeginDisabled(!o.solids());
  double percent = 100.0 * o.detail;
  if (slider(places, "Detail", percent, 100.0 * kFinest, 100.0 * kCoarsest, "%.1f %% of the casters",
             ImGuiSliderFlags_Logarithmic))
    o.detail = percent / 100.0;
  help_on_hover("Detail of this size is kept in the umbra and penumbra. Smaller takes longer.");
  ImGui::EndDisabled();
  cut_widgets(o, places);
}

}  // namespace penumbra::viewer
