// Chooses a mesh or a scene file: folders and files in a list, or a path that is typed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/panel/widgets.h"

namespace penumbra::viewer {

/// Scene files and meshes, by the extension.
bool can_be_opened(const std::filesystem::path& path);

class FileBrowser {
 public:
  /// Appears with the next `draw`. A folder that cannot be read is told in the dialog.
  void show(const std::filesystem::path& folder);
  /// Gone with the next `draw`.
  void hide() { closing_ = shown_; }
  bool shown() const { return shown_ && !closing_; }
  /// The file that was chosen. The dialog is then gone.
  std::optional<std::filesystem::path> draw(Places& places);

 private:
  struct Entry {
    std::string name;
    bool is_folder;
  };
  void enter(const std::filesystem::path& folder);
  /// A folder is entered, a file is chosen.
  std::optional<std::filesystem::path> take(const std::filesystem::path& path);
  std::optional<std::filesystem::path> draw_entries(Places& places);
  std::optional<std::filesystem::path> draw_buttons(Places& places);

  bool shown_ = false, appears_ = false, closing_ = false;
  std::filesystem::path folder_;
  std::string typed_, selected_, trouble_;
  std::vector<Entry> entries_;
};

}  // namespace penumbra::viewer
