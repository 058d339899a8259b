// Asks before a changed light is lost: by leaving, or by opening another file.
#pragma once

#include <filesystem>
#include <optional>

#include "apps/viewer/panel/widgets.h"

namespace penumbra::viewer {

class UnsavedQuestion {
 public:
  enum class Answer { kSave, kDiscard, kStay };
  /// Appears with the next `draw`. `then`: the file to open afterwards; none: the program is left.
  void ask(const std::optional<std::filesystem::path>& then);
  bool shown() const { return shown_ && !closing_; }
  const std::optional<std::filesystem::path>& then() const { return then_; }
  /// Gone with the next `draw`.
  void hide() { closing_ = shown_; }
  /// The answer, once. The question is then gone.
  std::optional<Answer> draw(Places& places);

 private:
  bool shown_ = false, appears_ = false, closing_ = false;
  std::optional<std::filesystem::path> then_;
};

}  // namespace penumbra::viewer
