#include "apps/viewer/panel/panel.h"

#include "apps/viewer/panel/cost_panel.h"
#include "apps/viewer/panel/light_panel.h"
#include "apps/viewer/panel/method_panel.h"
#include "apps/viewer/panel/overlay_panel.h"
#include "apps/viewer/panel/words.h"

namespace penumbra::viewer {

std::optional<Command> draw_panel(State& state, const PanelInput& input, Places& places) {
  ImGui::SetNextWindowPos({static_cast<float>(input.x), 0.0f});
  ImGui::SetNextWindowSize({static_cast<float>(input.width), static_cast<float>(input.height)});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_MenuBar);
  const std::optional<Command> chosen = draw_menus(input.menus, places);
  std::size_t faces = 0;
  for (const SceneObject& object : state.model->objects) faces += object.mesh.triangles().size();
  ImGui::Text("%s, %s faces", state.path.filename().c_str(), with_commas(faces).c_str());
  help_on_hover(state.path.string());
  picture_section(state, places);
  light_section(state, places);
  overlay_section(state, places);
  cost_section(input.frame, input.costs);
  ImGui::End();
  return chosen;
}

}  // namespace penumbra::viewer
