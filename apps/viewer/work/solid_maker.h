// Umbra and penumbra solids in the background: coarse ones first, then finer ones up to the detail that is
// wanted. What is under way for a light that has moved is given up; only the coarsest is made to its end, so
// that something is there while the light moves. Where that takes too long to follow a hand, nothing is made
// until the light is still.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/state/state.h"
#include "apps/viewer/work/solid_geometry.h"
#include "penumbra/render/visibility.h"

namespace penumbra::viewer {

/// All casters' solids for one light. Never changed once published.
struct Solids {
  std::shared_ptr<const Scene> model;
  LightShape light;
  double detail = 0.0;  ///< in parts of the casters' diagonal
  Vec3 origin{0.0};     ///< of the lists
  /// Absent where it was not wanted; without triangles where there is none.
  std::optional<std::vector<SolidVertex>> umbra, penumbra;
  std::string trouble;  ///< why they are not there
};

/// Details from the coarsest to the one that is wanted, each about half of the one before.
std::vector<double> details_down_to(double finest);

class SolidMaker {
 public:
  /// `wake` is called from the thread whenever a solid is ready.
  explicit SolidMaker(void (*wake)()) : wake_(wake) {}
  ~SolidMaker();
  /// To be called each window frame; `moving`: the light is being changed. The newest solids that are ready,
  /// null where none are wanted.
  std::shared_ptr<const Solids> update(const State& state, bool moving);
  /// They are not those of this state's light.
  bool outdated(const State& state) const;
  bool busy() const { return task_.valid(); }
  /// "solids: 40% of detail 2.5%"; empty where nothing is under way.
  std::string activity() const;

 private:
  struct Task;
  void start(const State& state, std::vector<double> details);
  void run(const Task& task);
  /// Throws Cancelled.
  std::shared_ptr<const Solids> make(const Task& task, double detail);
  std::vector<double> missing(const State& state, bool moving) const;

  void (*wake_)();
  std::future<void> task_;
  std::shared_ptr<Task> current_;
  std::atomic<double> fraction_{0.0}, detail_{0.0};
  std::atomic<double> coarsest_took_{0.0};  ///< seconds, the last time
  std::shared_ptr<const Solids> shown_;

  std::mutex mutex_;  ///< for what follows
  std::shared_ptr<const Solids> ready_;

  std::shared_ptr<const Casters> casters_;  ///< the task's; of the model casters_for_
  std::shared_ptr<const Scene> casters_for_;
};

}  // namespace penumbra::viewer
