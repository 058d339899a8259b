#include "apps/viewer/work/wishes.h"

namespace penumbra::viewer {
namespace {

constexpr auto kStill = std::chrono::milliseconds(150);
constexpr int kRefineTo = 8'192;

bool same_picture(const State& a, const State& b) {
  return a.model == b.model && a.lights == b.lights && a.selected == b.selected &&
         a.camera.eye == b.camera.eye && a.camera.target == b.camera.target && a.camera.up == b.camera.up &&
         a.camera.fov_y_degrees == b.camera.fov_y_degrees && a.left.width == b.left.width &&
         a.left.height == b.left.height && a.two_sided() == b.two_sided() && a.revision == b.revision &&
         a.overlays.textures == b.overlays.textures;
}

bool same_geometry(const State& a, const State& b) {
  return a.model == b.model && a.revision == b.revision && a.two_sided() == b.two_sided();
}

}  // namespace

void Wishes::update(const State& state, bool holding) {
  const auto now = std::chrono::steady_clock::now();
  if (asked_ == 0 || !same_picture(state, shown_)) {
    changed_ = now;
    const auto frame = worker_.latest();
    // Another method or scene is no movement: its full picture is what is wanted.
    if (asked_ == 0 || (!holding && !same_geometry(state, shown_))) return ask(state, false);
    // The next draft when the last one has arrived; a full picture under way gives way.
    const bool busy = moving_ && (!frame || frame->number != asked_);
    if (!busy) ask(state, true);
    moving_ = true;
    return;
  }
  if (moving_ && !holding && now - changed_ > kStill) ask(state, false);
}

void Wishes::ask(const State& state, bool draft) {
  shown_ = state;
  moving_ = draft;
  RenderJob job{.number = ++asked_,
                .model = state.model,
                .lights = state.lights,
                .selected = state.selected,
                .camera = state.camera,
                .sides = {state.left},
                .moving = draft,
                .refine_to = state.two_sided() ? kRefineTo : 0};
  job.sides.front().keep_textures = state.overlays.textures;
  if (state.two_sided()) {
    job.sides.push_back(state.right);
    job.sides.back().width = state.left.width;
    job.sides.back().height = state.left.height;
  }
  worker_.submit(std::move(job));
}

}  // namespace penumbra::viewer
