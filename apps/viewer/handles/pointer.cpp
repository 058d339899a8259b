#include "apps/viewer/handles/pointer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "apps/viewer/handles/aim.h"
#include "apps/viewer/handles/navigation.h"

namespace penumbra::viewer {
namespace {

constexpr double kTurn = 0.008;        // radians a pixel
constexpr double kZoom = 0.88;         // a notch of the wheel
constexpr double kDividerReach = 6.0;  // pixels
constexpr int kLeft = 0, kMiddle = 2;  // ImGui's buttons

}  // namespace

std::optional<std::size_t> pixel_at(const Frame& frame, const PicturePoint& at, int width, int height) {
  if (frame.sides.empty()) return std::nullopt;
  const SurfaceBuffer& surface = frame.sides.front().result->surface;
  const int x = static_cast<int>(std::floor(at.x * surface.width / width));
  const int y = static_cast<int>(std::floor(at.y * surface.height / height));
  if (x < 0 || y < 0 || x >= surface.width || y >= surface.height) return std::nullopt;
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(surface.width) + static_cast<std::size_t>(x);
  return surface.hit(pixel) ? std::optional(pixel) : std::nullopt;
}

void Pointer::update(State& state, const Frame* frame) {
  const ImGuiIO& io = ImGui::GetIO();
  const int width = state.left.width, height = state.left.height;
  const Projection projection(state.camera, width, height);
  const PicturePoint pointer{io.MousePos.x, io.MousePos.y};
  const bool inside = pointer.x >= 0.0 && pointer.y >= 0.0 && pointer.x < width && pointer.y < height;
  const bool ours = inside && !io.WantCaptureMouse;
  at_ = ours || dragging() ? std::optional(pointer) : std::nullopt;
  if (!dragging()) {
    hovered_ = ours && state.overlays.light
                   ? pick(handle_shape(state.handled(), projection), projection, pointer)
                   : Handle::kNone;
    over_divider_ = ours && state.arrangement == Arrangement::kSplit && hovered_ == Handle::kNone &&
                    std::abs(pointer.x - state.divider * width) < kDividerReach;
    for (const int button : {kLeft, kMiddle})
      if (ours && ImGui::IsMouseClicked(button)) press(state, projection, button);
    if (ours && ImGui::IsMouseDoubleClicked(kLeft) && frame && hovered_ == Handle::kNone)
      if (const auto pixel = pixel_at(*frame, pointer, width, height))
        state.camera = centered(state.camera, frame->sides.front().result->surface.position[*pixel]);
  } else if (!ImGui::IsMouseDown(button_)) {
    drag_ = Drag::kNone;
    held_.reset();
  } else if (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f) {
    drag(state, projection, io.MouseDelta.x, io.MouseDelta.y);
  }
  if (ours && io.MouseWheel != 0.0f) wheel(state, projection, frame, io.MouseWheel);
}

void Pointer::cancel(State& state) {
  if (!dragging()) return;
  drag_ = Drag::kNone;
  held_.reset();
  state.lights = before_->lights;
  state.camera = before_->camera;
  state.divider = before_->divider;
}

void Pointer::press(const State& state, const Projection& projection, int button) {
  button_ = button;
  before_ = state;
  if (button == kMiddle || ImGui::GetIO().KeyShift) {
    drag_ = Drag::kPan;
  } else if (hovered_ != Handle::kNone) {
    drag_ = Drag::kHandle;
    const HandledLight light = state.handled();
    held_.emplace(hovered_, light, projection, *at_,
                  state.aim && !light.middle ? lit_point(*state.model, light.disk) : std::nullopt);
  } else {
    drag_ = over_divider_ ? Drag::kDivider : Drag::kRotate;
  }
}

void Pointer::drag(State& state, const Projection& projection, double x_pixels, double y_pixels) {
  const int width = state.left.width, height = state.left.height;
  switch (drag_) {
    case Drag::kRotate:
      state.camera = rotated(state.camera, state.model->camera.up, -kTurn * x_pixels, kTurn * y_pixels);
      break;
    case Drag::kPan:
      state.camera = panned(state.camera, width, height, x_pixels, y_pixels);
      break;
    case Drag::kHandle:
      state.set_handled(held_->moved_to(projection, *at_));
      break;
    case Drag::kDivider:
      state.divider = std::clamp(at_->x / width, 0.02, 0.98);
      break;
    case Drag::kNone:
      break;
  }
}

void Pointer::wheel(State& state, const Projection& projection, const Frame* frame, double notches) const {
  double depth = projection.depth(state.camera.target);
  if (frame)
    if (const auto pixel = pixel_at(*frame, *at_, state.left.width, state.left.height))
      depth = projection.depth(frame->sides.front().result->surface.position[*pixel]);
  if (!(depth > 0.0)) return;
  const Vec3 pivot = projection.eye() + depth * projection.direction(*at_);
  state.camera = zoomed(state.camera, pivot, std::pow(kZoom, notches));
}

}  // namespace penumbra::viewer
