// What is open: its state, how it came to be (undo), and whether something would be lost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/viewer/state/history.h"
#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

class Document {
 public:
  /// Opens the file. `before` has the settings to start with, and the size of the picture. Throws what
  /// load_scene throws.
  Document(const std::filesystem::path& path, const State& before, bool keep_camera);

  const State& state() const { return state_; }
  /// What is changed here becomes a step of the history once `note` is called.
  State& state() { return state_; }
  /// Lines about what was opened; empty where there is nothing to say.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Forgets the history and what was unsaved: this is where it begins.
  void begin();
  /// To be called when no gesture is under way.
  void note() { history_.note(state_); }
  bool can_undo() const { return history_.can_undo(); }
  bool can_redo() const { return history_.can_redo(); }
  /// What was undone as a line to show.
  std::string undo();
  std::string redo();

  /// Lights are no longer what was read or saved last. Where one looks from, and how, is not asked about.
  bool unsaved() const { return state_.lights != saved_lights_; }
  void note_saved() { saved_lights_ = state_.lights; }

 private:
  State state_;
  std::vector<Light> saved_lights_;
  std::vector<std::string> warnings_;
  History history_;
};

}  // namespace penumbra::viewer
