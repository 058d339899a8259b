#include "apps/viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "apps/common/failures.h"
#include "apps/common/messages.h"
#include "apps/common/outputs.h"
#include "apps/viewer/actions.h"
#include "apps/viewer/commands.h"
#include "apps/viewer/handles/navigation.h"
#include "apps/viewer/handles/pointer.h"
#include "apps/viewer/panel.h"
#include "apps/viewer/pictures/overlay_pass.h"
#include "apps/viewer/pictures/picture_view.h"
#include "apps/viewer/pictures/probe_view.h"
#include "apps/viewer/random_input.h"
#include "apps/viewer/state/status.h"
#include "apps/viewer/window.h"
#include "apps/viewer/work/exports.h"
#include "apps/viewer/work/wishes.h"
#include "penumbra/mesh/error.h"
#include "render/gl/context.h"

namespace penumbra::viewer {
namespace {

class Viewer {
 public:
  Viewer(ViewerOptions options, State state, std::string message);
  int run();

 private:
  void wait();
  void play();
  void rest();
  void draw();
  void fit_picture();
  void obey(Command command);
  void obey_view(Command command);
  void keys();
  void open(const std::filesystem::path& path);
  void open_neighbor(int step);
  void take_screenshot_when_due();
  bool too_soon() const;
  bool settled() const { return wishes_.settled(view_.frame()); }
  void draw_help();
  void draw_overlays();

  ViewerOptions options_;
  State state_;
  std::string message_;
  Window window_;
  RenderWorker worker_;
  Wishes wishes_;
  PictureView view_;
  OverlayMaker overlay_maker_;
  OverlayPass overlay_pass_;
  ProbeView probe_;
  Exports exports_;
  Pointer pointer_;
  Panel panel_;
  Costs costs_;
  StatusFile status_;
  std::optional<RandomInput> random_input_;
  State first_;  ///< as it was opened
  bool goes_to_rest_ = true;
  int rested_frames_ = 0;  ///< with everything shown
  bool show_panel_, show_help_ = false;
  int frames_ = 0;                                 ///< drawn so far
  std::chrono::steady_clock::time_point drawn_{};  ///< when the last was
  int frames_to_draw_ = 3;  ///< ImGui needs some after each event until everything is in place
  std::size_t file_ = 0;
};

Viewer::Viewer(ViewerOptions options, State state, std::string message)
    : options_(std::move(options)),
      state_(std::move(state)),
      message_(std::move(message)),
      window_(options_.width + (options_.plain ? 0 : kPanelWidth), options_.height,
              "Penumbra - " + state_.path.filename().string()),
      worker_(&Window::wake),
      wishes_(worker_),
      view_(window_.functions()),
      overlay_maker_(&Window::wake),
      overlay_pass_(window_.functions()),
      probe_(window_.functions(), &Window::wake),
      exports_(&Window::wake),
      status_(options_.status),
      show_panel_(!options_.plain) {
  if (options_.random_input) random_input_.emplace(*options_.random_input, options_.seconds, options_.files);
  first_ = state_;
}

int Viewer::run() {
  while (!window_.closing()) {
    wait();
    play();
    for (const std::string& dropped : window_.take_dropped()) open(dropped);
    if (window_.minimised()) continue;
    const auto frame = worker_.latest();
    const bool news = frame && frame.get() != view_.frame();
    if (!news && too_soon()) continue;
    if (news) {
      costs_.add(*frame);
      frames_to_draw_ = std::max(frames_to_draw_, 1);
    }
    view_.update(state_, frame);
    window_.begin_frame();
    draw();
    window_.draw_frame();
    drawn_ = std::chrono::steady_clock::now();
    ++frames_;
    take_screenshot_when_due();
    window_.show_frame();
  }
  if (!random_input_) return apps::kFine;
  apps::complain(random_input_->summary());
  return random_input_->memory_stayed() ? apps::kFine : apps::kFailed;
}

// What tests do to the window from inside.
void Viewer::play() {
  if (!options_.drop.empty() && settled()) window_.drop(std::exchange(options_.drop, {}));
  if (!random_input_) return;
  frames_to_draw_ = 1;
  if (random_input_->rests()) return rest();
  if (const auto command = random_input_->act(window_)) obey(*command);
}

// Back to what was shown at first; once all of it is there, what it takes is noted.
void Viewer::rest() {
  if (std::exchange(goes_to_rest_, false)) {
    window_.use_hand({});
    window_.set_size(options_.width + (options_.plain ? 0 : kPanelWidth), options_.height);
    const int revision = state_.revision + 1;
    state_ = first_;
    state_.revision = revision;
    show_panel_ = !options_.plain;
    show_help_ = false;
    rested_frames_ = 0;
  }
  const bool busy = overlay_maker_.busy() || probe_.busy() || exports_.busy();
  rested_frames_ = settled() && !busy && state_.left.width == options_.width ? rested_frames_ + 1 : 0;
  if (rested_frames_ < 10) return;
  random_input_->note_memory();
  goes_to_rest_ = true;
  if (random_input_->done()) window_.close();
}

// Sleeps where nothing is to be done: until an event, or until it is time to ask for the full picture.
void Viewer::wait() {
  // A press and its release may come at once: the window sees the second a frame later, without an event.
  if (ImGui::IsAnyMouseDown()) frames_to_draw_ = 2;
  const bool busy = pointer_.dragging() || (!options_.screenshot.empty() && settled());
  if (frames_to_draw_ > 0) {
    --frames_to_draw_;
    return window_.wait(busy ? 0.008 : 0.016);
  }
  window_.wait(wishes_.restless()            ? 0.03
               : window_.minimised()         ? 0.5
               : options_.screenshot.empty() ? -1.0
                                             : 0.03);
  frames_to_draw_ = 2;
}

// While a draft is under way the window waits for it, but not for long: without a GPU drawing the window
// takes as much of the processor as a draft does.
bool Viewer::too_soon() const {
  constexpr auto kLongestWait = std::chrono::milliseconds(45);
  return wishes_.restless() && std::chrono::steady_clock::now() - drawn_ < kLongestWait;
}

void Viewer::fit_picture() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const int panel = show_panel_ ? kPanelWidth : 0;
  state_.left.width = std::max(16, static_cast<int>(size.x) - panel);
  state_.left.height = std::max(16, static_cast<int>(size.y));
  state_.right.width = state_.left.width;
  state_.right.height = state_.left.height;
}

void Viewer::draw() {
  fit_picture();
  keys();
  pointer_.update(state_, view_.frame());
  view_.draw_picture(state_);
  draw_overlays();
  view_.draw_marks(state_, pointer_, settled());
  if (show_panel_) {
    const PanelInput input{.frame = view_.frame(),
                           .costs = &costs_,
                           .message = message_,
                           .settled = settled(),
                           .x = state_.left.width,
                           .height = state_.left.height};
    if (const auto command = panel_.draw(state_, input)) obey(*command);
  }
  probe_.draw(state_, view_.frame(), pointer_);
  if (show_help_) draw_help();
  if (const std::string news = exports_.news(); !news.empty()) message_ = news;
  const bool holding = pointer_.dragging() || ImGui::IsAnyItemActive();
  wishes_.update(state_, holding);
  status_.update({.state = state_,
                  .settled = settled(),
                  .holding = holding,
                  .frame = view_.frame(),
                  .places = panel_.places(),
                  .message = message_,
                  .minimised = window_.minimised(),
                  .per_second = costs_.per_second()});
}

void Viewer::keys() {
  const std::vector<Window::Key> pressed = window_.take_keys();
  if (ImGui::GetIO().WantTextInput) return;
  for (const Window::Key& key : pressed)
    for (const CommandKey& each : command_keys())
      if (each.key == key.key && each.shift == key.shift && each.control == key.control) obey(each.command);
}

void Viewer::obey_view(Command command) {
  const Vec3 up = state_.model->camera.up;
  const int width = state_.left.width, height = state_.left.height;
  switch (command) {
    case Command::kViewFront:
      state_.camera = seen_from(state_.camera, up, StandardView::kFront);
      break;
    case Command::kViewRight:
      state_.camera = seen_from(state_.camera, up, StandardView::kRight);
      break;
    case Command::kViewTop:
      state_.camera = seen_from(state_.camera, up, StandardView::kTop);
      break;
    case Command::kFrameAll:
    case Command::kFrameLight: {
      Bounds bounds = state_.model->caster_bounds();
      if (command == Command::kFrameLight) bounds.add(state_.handled().disk.center);
      state_.camera = framed(state_.camera, bounds, width, height);
      break;
    }
    case Command::kReset:
      state_.camera = state_.model->camera;
      state_.lights = state_.model->lights;
      break;
    default:
      break;
  }
}

void Viewer::obey(Command command) {
  Overlays& o = state_.overlays;
  switch (command) {
    case Command::kNextMethod:
      state_.left.method = next_method(state_.left.method, 1);
      ++state_.revision;
      break;
    case Command::kPreviousMethod:
      state_.left.method = next_method(state_.left.method, -1);
      ++state_.revision;
      break;
    case Command::kSingle:
      state_.arrangement = Arrangement::kSingle;
      break;
    case Command::kSplit:
      state_.arrangement = Arrangement::kSplit;
      break;
    case Command::kDifference:
      state_.arrangement = Arrangement::kDifference;
      break;
    case Command::kLightHandles:
      o.light = !o.light;
      break;
    case Command::kFaces:
      o.faces = !o.faces;
      break;
    case Command::kSilhouettes:
      o.silhouettes = !o.silhouettes;
      break;
    case Command::kBand:
      o.band = !o.band;
      break;
    case Command::kSheets:
      o.sheets = !o.sheets;
      break;
    case Command::kPenumbraVolume:
      o.penumbra = !o.penumbra;
      break;
    case Command::kUmbraVolume:
      o.umbra = !o.umbra;
      break;
    case Command::kProbe:
      state_.probe = !state_.probe;
      break;
    case Command::kPanel:
      show_panel_ = !show_panel_;
      break;
    case Command::kHelp:
      show_help_ = !show_help_;
      break;
    case Command::kLeave:
      window_.close();
      break;
    case Command::kNextFile:
      open_neighbor(1);
      break;
    case Command::kPreviousFile:
      open_neighbor(-1);
      break;
    case Command::kSavePicture:
    case Command::kSaveState:
    case Command::kCopyCommand:
      message_ =
          perform(command,
                  {.state = state_, .frame = view_.frame(), .settled = settled(), .folder = options_.output});
      break;
    case Command::kExportVolumes:
      message_ = exports_.start(export_volumes, options_.output, state_);
      break;
    case Command::kExportSequence:
      message_ = exports_.start(export_sequence, options_.output, state_);
      break;
    default:
      obey_view(command);
  }
}

void Viewer::open(const std::filesystem::path& path) {
  try {
    LoadedScene loaded = load_scene(path);
    state_ = opened(path, loaded, state_);
    ++state_.revision;
    message_ = loaded.warnings.empty() ? "" : loaded.warnings.front();
    window_.set_title("Penumbra - " + path.filename().string());
  } catch (const std::exception& e) {
    message_ = e.what();
  }
  frames_to_draw_ = 3;
}

void Viewer::open_neighbor(int step) {
  const std::size_t count = options_.files.size();
  if (count < 2) return;
  file_ = (file_ + count + static_cast<std::size_t>(step + static_cast<int>(count))) % count;
  open(options_.files[file_]);
}

void Viewer::take_screenshot_when_due() {
  if (options_.screenshot.empty() || frames_ < options_.frames || !settled() || overlay_maker_.busy() ||
      probe_.busy())
    return;
  int width = 0, height = 0;
  const std::vector<unsigned char> pixels = window_.read_pixels(width, height);
  write_png(options_.screenshot, width, height, pixels);
  window_.close();
}

// Between the picture and the light's handles, inside ImGui's own drawing.
void Viewer::draw_overlays() {
  overlay_pass_.set(overlay_maker_.update(state_));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto draw = [](const ImDrawList*, const ImDrawCmd* command) {
    const auto& viewer = *static_cast<const Viewer*>(command->UserCallbackData);
    viewer.overlay_pass_.draw(viewer.state_, viewer.state_.left.width, viewer.state_.left.height);
  };
  list.AddCallback(draw, this);
  list.AddCallback(ImDrawCallback_ResetRenderState, nullptr);
}

void Viewer::draw_help() {
  ImGui::SetNextWindowPos({20, 20});
  ImGui::SetNextWindowSize({680, 0});
  ImGui::Begin("Keys", &show_help_, ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextUnformatted(
      "Left drag turns, middle or Shift drag pans, the wheel zooms to the pointer,\n"
      "a double click sets the center. Drag the light's arrows, its center, the tip\n"
      "of its normal (tilt) or its rim (radius). Files dropped on the window open.");
  ImGui::Separator();
  ImGui::Columns(2, "keys", false);
  for (const CommandKey& each : command_keys())
    ImGui::Text("%-11s %s", each.shown, each.help), ImGui::NextColumn();
  ImGui::Columns(1);
  ImGui::End();
}

// Before any other GL library of this process: its entry points must not be found in libGL's place.
void open_osmesa_first() {
  try {
    gl::make_context(gl::Backend::kOsMesa);
  } catch (const Error&) {  // the method that needs it says so when it is chosen
  }
}

}  // namespace

int show(ViewerOptions options) {
  LoadedScene loaded = load_scene(options.files.front());
  State state = opened(options.files.front(), loaded, options.state);
  if (options.method) state.left.method = *options.method;
  if (options.view) state.arrangement = *options.view;
  if (options.plain) state.overlays = {.light = false};
  for (const std::string& warning : loaded.warnings) apps::complain("warning: " + warning);
  open_osmesa_first();
  const std::string message = loaded.warnings.empty() ? "" : loaded.warnings.front();
  Viewer viewer(std::move(options), std::move(state), message);
  return viewer.run();
}

}  // namespace penumbra::viewer
