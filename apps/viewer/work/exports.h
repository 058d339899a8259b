// What the viewer writes besides one picture: volumes as meshes, a sequence of pictures along the light's
// path.
#pragma once

#include <filesystem>
#include <future>
#include <string>

#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// FOLDER/STEM-sheets.ply, -penumbra.ply and -umbra.ply of all casters, as `penumbra volumes --form cells` makes them.
/// Returns what was written in one line. Throws SystemError.
std::string export_volumes(const std::filesystem::path& folder, const State& state);

/// The light's disk on its way from that of the file to that of now: `t` in [0, 1].
HandledLight light_on_path(const State& state, double t);

/// 24 pictures of the left method along the light's path: FOLDER/STEM-path-001.png and on, full quality.
/// Throws SystemError and what rendering throws.
std::string export_sequence(const std::filesystem::path& folder, const State& state);

/// One export at a time on a thread of its own.
class Exports {
 public:
  explicit Exports(void (*wake)()) : wake_(wake) {}
  ~Exports();
  /// Starts it, or says that another one is still running.
  std::string start(std::string (*work)(const std::filesystem::path&, const State&),
                    const std::filesystem::path& folder, const State& state);
  /// What the last export said when it had finished; empty where there is nothing new.
  std::string news();
  bool busy() const { return task_.valid(); }

 private:
  void (*wake_)();
  std::future<std::string> task_;
};

}  // namespace penumbra::viewer
