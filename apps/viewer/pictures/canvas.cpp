#include "apps/viewer/pictures/canvas.h"

#include <imgui.h>

namespace penumbra::viewer {

Canvas::Canvas(const gl::Functions& gl, bool plain, void (*wake)())
    : view_(gl, plain),
      overlay_maker_(wake),
      overlay_pass_(gl),
      solid_maker_(wake),
      solid_pass_(gl),
      probe_(gl, wake) {}

void Canvas::draw(const State& state, const CanvasInput& input) {
  view_.draw_picture(state);
  overlay_pass_.set(overlay_maker_.update(state));
  solids_ = solid_maker_.update(state, input.moving);
  solid_pass_.set(solids_);
  drawn_ = &state;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddCallback(
      [](const ImDrawList*, const ImDrawCmd* command) {
        static_cast<Canvas*>(command->UserCallbackData)->draw_geometry();
      },
      this);
  list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
  view_.draw_marks(state,
                   {.pointer = input.pointer, .settled = input.settled, .per_second = input.per_second});
  probe_.draw(state, view_.frame(), input.pointer);
}

// Between the picture and the light's handles, inside ImGui's own drawing.
void Canvas::draw_geometry() {
  const State& state = *drawn_;
  const int bottom = static_cast<int>(ImGui::GetIO().DisplaySize.y) - state.left.height;
  const Viewport place{.bottom = bottom, .width = state.left.width, .height = state.left.height};
  overlay_pass_.draw(state, place);
  if (const OverlayGeometry* geometry = overlay_pass_.geometry())
    solid_pass_.draw(state, *geometry, place, solid_maker_.outdated(state));
}

}  // namespace penumbra::viewer
