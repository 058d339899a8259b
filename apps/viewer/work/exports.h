// What the viewer writes besides one picture: umbra and penumbra as solids, sheets and cells, a sequence of
// pictures along the light's path.
#pragma once

#include <atomic>
#include <filesystem>
#include <future>
#include <memory>
#include <string>

#include "apps/viewer/state/state.h"
#include "penumbra/mesh/progress.h"

namespace penumbra::viewer {

/// Writes files into a folder and returns in one line what was written. Throws what it meets outside, and
/// Cancelled.
struct Export {
  const char* name;  ///< "umbra and penumbra"
  std::string (*run)(const std::filesystem::path& folder, const State& state, const Progress& progress);
};

/// FOLDER/STEM-001-umbra.ply and -penumbra.ply: the solids of all casters together under the selected light,
/// as `penumbra volumes --merge` makes them, or finer where the panel asks for more detail. The number is the
/// first for which there are no files.
extern const Export kSolidExport;
/// FOLDER/STEM-001-sheets.ply, -penumbra-cells.ply and -umbra-cells.ply of all casters, as `penumbra volumes
/// --form cells` makes them.
extern const Export kCellExport;
/// FOLDER/STEM-path-001.png and on: 24 pictures of the left method along the light's path, full quality.
extern const Export kSequenceExport;

/// The light's disk on its way from that of the file to that of now: `t` in [0, 1].
HandledLight light_on_path(const State& state, double t);

/// One export at a time on a thread of its own.
class Exports {
 public:
  /// `wake` is called from the thread when an export has ended.
  explicit Exports(void (*wake)()) : wake_(wake) {}
  /// Gives up what is under way.
  ~Exports();
  /// Starts it, or says that another one is still running.
  std::string start(const Export& work, const std::filesystem::path& folder, const State& state);
  /// What is under way ends soon, with nothing more written.
  void cancel();
  /// What the last export said when it had finished; empty where there is nothing new.
  std::string news();
  bool busy() const { return task_.valid(); }
  /// "exporting umbra and penumbra: 40%"; empty where nothing is under way.
  std::string activity() const;

 private:
  /// What the thread and the window share.
  struct Run {
    const char* name = "";
    std::atomic<double> fraction = 0.0;
    std::atomic<bool> cancelled = false;
  };

  void (*wake_)();
  std::shared_ptr<Run> run_;
  std::future<std::string> task_;
};

}  // namespace penumbra::viewer
