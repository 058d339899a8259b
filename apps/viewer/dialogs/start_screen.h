// The window before anything is open: a button to open a file, and the place to drop one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "apps/viewer/dialogs/file_browser.h"
#include "apps/viewer/window/window.h"

namespace penumbra::viewer {

class StartScreen {
 public:
  explicit StartScreen(Window& window) : window_(window) {}
  struct Choice {
    std::optional<std::filesystem::path> file;
    bool leave = false;
  };
  /// One frame of the window: draws it, reads keys and dropped files.
  Choice draw(const std::string& message);
  const Places& places() const { return places_; }

 private:
  void read_keys(Choice& choice);
  bool draw_middle(const std::string& message);

  Window& window_;
  FileBrowser browser_;
  Places places_;
};

}  // namespace penumbra::viewer
