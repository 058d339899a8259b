#include "apps/viewer/state/state_commands.h"

#include <algorithm>

#include "apps/viewer/handles/navigation.h"

namespace penumbra::viewer {
namespace {

// Null: the command is no overlay's.
bool* overlay_of(State& state, Command command) {
  Overlays& o = state.overlays;
  switch (command) {
    case Command::kLightHandles:
      return &o.light;
    case Command::kFaces:
      return &o.faces;
    case Command::kSilhouettes:
      return &o.silhouettes;
    case Command::kBand:
      return &o.band;
    case Command::kSheets:
      return &o.sheets;
    case Command::kPenumbraCells:
      return &o.penumbra;
    case Command::kUmbraCells:
      return &o.umbra;
    case Command::kPenumbraSolid:
      return &o.penumbra_solid;
    case Command::kUmbraSolid:
      return &o.umbra_solid;
    case Command::kProbe:
      return &state.probe;
    default:
      return nullptr;
  }
}

bool change_view(State& state, Command command) {
  const Vec3 up = state.model->camera.up;
  Bounds bounds = state.model->caster_bounds();
  switch (command) {
    case Command::kViewFront:
      state.camera = seen_from(state.camera, up, StandardView::kFront);
      return true;
    case Command::kViewRight:
      state.camera = seen_from(state.camera, up, StandardView::kRight);
      return true;
    case Command::kViewTop:
      state.camera = seen_from(state.camera, up, StandardView::kTop);
      return true;
    case Command::kFrameLight:
      bounds.add(state.handled().disk.center);
      [[fallthrough]];
    case Command::kFrameAll:
      state.camera = framed(state.camera, bounds, state.left.width, state.left.height);
      return true;
    case Command::kReset:
      state.camera = state.model->camera;
      state.lights = state.model->lights;
      return true;
    default:
      return false;
  }
}

bool change_picture(State& state, Command command) {
  switch (command) {
    case Command::kNextMethod:
    case Command::kPreviousMethod:
      state.left.method = next_method(state.left.method, command == Command::kNextMethod ? 1 : -1);
      ++state.revision;
      return true;
    case Command::kSingle:
      state.arrangement = Arrangement::kSingle;
      return true;
    case Command::kSplit:
      state.arrangement = Arrangement::kSplit;
      return true;
    case Command::kDifference:
      state.arrangement = Arrangement::kDifference;
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string next_method(const std::string& method, int step) {
  const std::deque<MethodInfo>& all = methods();
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  const auto at = std::ranges::find(all, method, &MethodInfo::name) - all.begin();
  return all[static_cast<std::size_t>((at + step + count) % count)].name;
}

bool change_state(State& state, Command command) {
  if (bool* overlay = overlay_of(state, command)) {
    *overlay = !*overlay;
    return true;
  }
  return change_picture(state, command) || change_view(state, command);
}

}  // namespace penumbra::viewer
