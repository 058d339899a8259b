// --status: what the window shows, as JSON in a file, for scripts and tests that drive it.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/viewer/handles/projection.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

struct StatusInput {
  const State& state;
  bool settled;
  bool holding;        ///< a drag or a slider is under way
  const Frame* frame;  ///< may be null
  const std::map<std::string, PicturePoint>& places;
  const std::string& message;
  const std::string& activity;  ///< what is being made beside the picture, in words
  bool minimised;
  int per_second;  ///< pictures that arrived in the last second
  bool unsaved, can_undo, can_redo;
  std::string dialog;   ///< "unsaved", "open", "help" or none
  double solid_detail;  ///< of the solids that are shown; 0: none are
};

class StatusFile {
 public:
  /// An empty path: nothing is ever written.
  explicit StatusFile(std::filesystem::path path) : path_(std::move(path)) {}
  /// Writes the file, whole, where it would say something else than last time.
  void update(const StatusInput& input);
  /// Nothing is open.
  void update_empty(const std::map<std::string, PicturePoint>& places, const std::string& message);

 private:
  void write(const nlohmann::json& json);

  std::filesystem::path path_;
  std::string written_;
};

}  // namespace penumbra::viewer
