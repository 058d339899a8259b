#include "apps/viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "apps/common/failures.h"
#include "apps/common/messages.h"
#include "apps/viewer/dialogs/help_window.h"
#include "apps/viewer/panel/panel.h"
#include "apps/viewer/panel/status_line.h"

namespace penumbra::viewer {

Viewer::Viewer(Window& window, ViewerOptions options, Document document)
    : window_(window),
      options_(std::move(options)),
      document_(std::move(document)),
      worker_(&Window::wake),
      wishes_(worker_),
      canvas_(window.functions(), options_.plain, &Window::wake),
      exports_(&Window::wake),
      status_(options_.status),
      show_panel_(!options_.plain),
      first_(document_.state()) {
  message_ = document_.warnings().empty()
                 ? "Drag the light by its arrows, its center or its rim. H shows mouse and keys."
                 : document_.warnings().front();
  if (options_.random_input) random_input_.emplace(*options_.random_input, options_.seconds, options_.files);
  name_window();
}

int Viewer::run() {
  while (!leaving_) {
    wait();
    play();
    if (window_.closing()) {
      window_.stay_open();
      want_to_leave();
    }
    for (const std::string& dropped : window_.take_dropped()) want_to_open(dropped);
    if (window_.minimised()) continue;
    const auto frame = worker_.latest();
    const bool news = frame && frame.get() != canvas_.frame();
    if (!news && too_soon()) continue;
    if (news) {
      costs_.add(*frame);
      frames_to_draw_ = std::max(frames_to_draw_, 1);
    }
    draw_frame(frame);
  }
  if (!random_input_) return apps::kFine;
  apps::complain(random_input_->summary());
  return random_input_->memory_stayed() ? apps::kFine : apps::kFailed;
}

void Viewer::draw_frame(const std::shared_ptr<const Frame>& frame) {
  canvas_.show(frame);
  window_.begin_frame();
  draw();  // asks for the next picture, which is made while this one is drawn
  canvas_.upload(state());
  window_.draw_frame();
  drawn_ = std::chrono::steady_clock::now();
  ++frames_;
  take_screenshot_when_due();
  window_.show_frame();
}

// Sleeps where nothing is to be done: until an event, or until it is time to ask for the full picture.
void Viewer::wait() {
  // A press and its release may come at once: the window sees the second a frame later, without an event.
  if (ImGui::IsAnyMouseDown()) frames_to_draw_ = 2;
  const bool busy = pointer_.dragging() || (!options_.screenshot.empty() && settled());
  if (frames_to_draw_ > 0) {
    --frames_to_draw_;
    if (window_.wait(busy ? 0.008 : 0.016)) frames_to_draw_ = 2;
    return;
  }
  window_.wait(wishes_.restless()             ? 0.03
               : window_.minimised()          ? 0.5
               : !options_.screenshot.empty() ? 0.03
               : !activity().empty()          ? 0.2  // it tells how far it is
                                              : -1.0);
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
  const int panel = show_panel_ ? window_.look().panel_width() : 0;
  const int status = options_.plain ? 0 : window_.look().status_height();
  State& s = state();
  s.left.width = s.right.width = std::max(16, static_cast<int>(size.x) - panel);
  s.left.height = s.right.height = std::max(16, static_cast<int>(size.y) - status);
}

void Viewer::draw() {
  places_.clear();
  fit_picture();
  keys();
  pointer_.update(state(), canvas_.frame());
  canvas_.draw(state(), {.pointer = pointer_,
                         .settled = settled(),
                         .moving = holding_ || wishes_.restless(),
                         .per_second = costs_.per_second()});
  draw_panel_and_status();
  draw_dialogs();
  if (const std::string news = exports_.news(); !news.empty()) message_ = news;
  holding_ = pointer_.dragging() || ImGui::IsAnyItemActive();
  if (!holding_) document_.note();
  wishes_.update(state(), holding_);
  update_status(holding_);
}

// What is wrong with what is shown comes before what was done last.
std::string Viewer::message() const {
  if (const Frame* frame = canvas_.frame(); frame && !frame->trouble.empty())
    return "no picture: " + frame->trouble;
  if (const std::string trouble = canvas_.trouble(); !trouble.empty()) return "no solids: " + trouble;
  return message_;
}

std::string Viewer::activity() const {
  const std::string solids = canvas_.activity(), files = exports_.activity();
  return solids + (solids.empty() || files.empty() ? "" : "; ") + files;
}

void Viewer::draw_panel_and_status() {
  if (show_panel_) {
    const PanelInput input{.frame = canvas_.frame(),
                           .costs = costs_,
                           .menus = {.can_undo = document_.can_undo(),
                                     .can_redo = document_.can_redo(),
                                     .several_files = options_.files.size() > 1,
                                     .close = std::exchange(close_menus_, false)},
                           .x = state().left.width,
                           .width = window_.look().panel_width(),
                           .height = state().left.height};
    if (const auto command = draw_panel(state(), input, places_)) obey(*command);
  }
  if (options_.plain) return;
  const std::string more = activity(), picture = picture_in_words(canvas_.frame(), settled());
  draw_status_line({.message = message(),
                    .activity = more.empty() ? picture : more + "; " + picture,
                    .y = state().left.height,
                    .width = static_cast<int>(ImGui::GetIO().DisplaySize.x),
                    .height = window_.look().status_height()});
}

void Viewer::draw_dialogs() {
  if (show_help_) draw_help(show_help_);
  if (const auto chosen = browser_.draw(places_)) want_to_open(*chosen);
  if (const auto given = question_.draw(places_)) answer(*given);
}

void Viewer::update_status(bool holding) {
  status_.update({.state = state(),
                  .settled = settled(),
                  .holding = holding,
                  .frame = canvas_.frame(),
                  .places = places_,
                  .message = message(),
                  .activity = activity(),
                  .minimised = window_.minimised(),
                  .per_second = costs_.per_second(),
                  .unsaved = document_.unsaved(),
                  .can_undo = document_.can_undo(),
                  .can_redo = document_.can_redo(),
                  .dialog = question_.shown()  ? "unsaved"
                            : browser_.shown() ? "open"
                            : show_help_       ? "help"
                                               : "",
                  .solid_detail = canvas_.solid_detail()});
}

void Viewer::take_screenshot_when_due() {
  if (options_.screenshot.empty() || frames_ < options_.frames || !settled() || canvas_.busy()) return;
  int width = 0, height = 0;
  const std::vector<unsigned char> pixels = window_.read_pixels(width, height);
  write_png(options_.screenshot, width, height, pixels);
  leaving_ = true;
}

}  // namespace penumbra::viewer
