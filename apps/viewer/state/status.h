// --status: what the window shows, as JSON in a file, for scripts and tests that drive it.
#pragma once

#include <filesystem>
#include <map>
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
  bool minimised;
  int per_second;  ///< pictures that arrived in the last second
};

class StatusFile {
 public:
  /// An empty path: nothing is ever written.
  explicit StatusFile(std::filesystem::path path) : path_(std::move(path)) {}
  /// Writes the file, whole, where it would say something else than last time.
  void update(const StatusInput& input);

 private:
  std::filesystem::path path_;
  std::string written_;
};

}  // namespace penumbra::viewer
