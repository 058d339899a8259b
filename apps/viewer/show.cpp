#include "apps/viewer/show.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/common/failures.h"
#include "apps/common/messages.h"
#include "apps/viewer/dialogs/start_screen.h"
#include "apps/viewer/viewer.h"
#include "penumbra/mesh/error.h"
#include "render/gl/context.h"

namespace penumbra::viewer {
namespace {

// Before any other GL library of this process: its entry points must not be found in libGL's place.
void open_osmesa_first() {
  try {
    gl::make_context(gl::Backend::kOsMesa);
  } catch (const Error&) {  // the method that needs it says so when it is chosen
  }
}

Document document_of(const std::filesystem::path& path, const ViewerOptions& options) {
  Document document(path, options.state, options.plain);
  if (options.method) document.state().left.method = *options.method;
  if (options.view) document.state().arrangement = *options.view;
  if (options.plain) document.state().overlays = {.light = false};
  document.begin();
  return document;
}

void write_screenshot(const Window& window, const std::filesystem::path& path) {
  int width = 0, height = 0;
  const std::vector<unsigned char> pixels = window.read_pixels(width, height);
  write_png(path, width, height, pixels);
}

// Until a file was opened; nothing where the window was closed before.
std::optional<Document> ask_for_file(Window& window, ViewerOptions& options) {
  StartScreen screen(window);
  StatusFile status(options.status);
  std::string message;
  int frames_to_draw = 3;
  for (int frames = 0; !window.closing();) {
    const bool rests = frames_to_draw == 0 && options.screenshot.empty();
    const bool event = window.wait(rests ? -1.0 : 0.016);
    frames_to_draw = event ? 2 : std::max(0, frames_to_draw - 1);  // the last events need frames as well
    if (window.minimised()) continue;
    window.begin_frame();
    const StartScreen::Choice choice = screen.draw(message);
    window.draw_frame();
    if (!options.screenshot.empty() && ++frames >= std::max(3, options.frames)) {
      write_screenshot(window, options.screenshot);
      return std::nullopt;
    }
    window.show_frame();
    if (choice.leave) return std::nullopt;
    if (choice.file) {
      try {
        options.files = {*choice.file};
        return document_of(*choice.file, options);
      } catch (const std::exception& e) {
        message = e.what();
      }
    }
    status.update_empty(screen.places(), message);
  }
  return std::nullopt;
}

}  // namespace

int show(ViewerOptions options) {
  options.state.left.width = options.state.right.width = options.width;
  options.state.left.height = options.state.right.height = options.height;
  std::optional<Document> document;
  if (!options.files.empty()) {
    document = document_of(options.files.front(), options);
    for (const std::string& warning : document->warnings()) apps::complain("warning: " + warning);
  }
  open_osmesa_first();
  Window window(
      {.width = options.width, .height = options.height, .plain = options.plain, .font = options.font_size});
  if (!document) document = ask_for_file(window, options);
  if (!document) return apps::kFine;
  return Viewer(window, std::move(options), std::move(*document)).run();
}

}  // namespace penumbra::viewer
