// The window while something is open: the loop over its frames, and what commands do.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "apps/viewer/commands.h"
#include "apps/viewer/dialogs/file_browser.h"
#include "apps/viewer/dialogs/unsaved_question.h"
#include "apps/viewer/handles/pointer.h"
#include "apps/viewer/panel/widgets.h"
#include "apps/viewer/pictures/canvas.h"
#include "apps/viewer/state/document.h"
#include "apps/viewer/state/status.h"
#include "apps/viewer/viewer_options.h"
#include "apps/viewer/window/random_input.h"
#include "apps/viewer/window/window.h"
#include "apps/viewer/work/costs.h"
#include "apps/viewer/work/exports.h"
#include "apps/viewer/work/wishes.h"

namespace penumbra::viewer {

class Viewer {
 public:
  Viewer(Window& window, ViewerOptions options, Document document);
  /// Until the window is closed. Returns the exit code.
  int run();

 private:
  // The loop (viewer.cpp).
  void wait();
  bool too_soon() const;
  void draw_frame(const std::shared_ptr<const Frame>& frame);
  void draw();
  void fit_picture();
  void draw_panel_and_status();
  void draw_dialogs();
  void update_status(bool holding);
  void take_screenshot_when_due();
  bool settled() const { return wishes_.settled(canvas_.frame()); }
  std::string message() const;
  /// What is being made beside the picture, in words; empty where nothing is.
  std::string activity() const;
  State& state() { return document_.state(); }
  const State& state() const { return document_.state(); }

  // Commands (viewer_commands.cpp).
  void keys();
  void obey(Command command);
  void obey_file(Command command);
  void escape();
  void want_to_open(const std::filesystem::path& path);
  void want_to_leave();
  void open(const std::filesystem::path& path);
  void open_neighbor(int step);
  void answer(UnsavedQuestion::Answer answer);
  void name_window();

  // What tests do to the window from inside (viewer_rest.cpp).
  void play();
  void rest();

  Window& window_;
  ViewerOptions options_;
  Document document_;
  std::string message_;
  RenderWorker worker_;
  Wishes wishes_;
  Canvas canvas_;
  Exports exports_;
  Pointer pointer_;
  Costs costs_;
  StatusFile status_;
  FileBrowser browser_;
  UnsavedQuestion question_;
  Places places_;  ///< of the widgets of this frame
  bool show_panel_, show_help_ = false, close_menus_ = false;
  bool leaving_ = false, holding_ = false;
  int frames_ = 0;                                 ///< drawn so far
  std::chrono::steady_clock::time_point drawn_{};  ///< when the last was
  int frames_to_draw_ = 3;  ///< ImGui needs some after each event until everything is in place
  std::size_t file_ = 0;

  std::optional<RandomInput> random_input_;
  State first_;  ///< as it was opened
  bool goes_to_rest_ = true;
  int rested_frames_ = 0;  ///< with everything shown
};

}  // namespace penumbra::viewer
