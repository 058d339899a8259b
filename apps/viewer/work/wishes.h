// Which pictures are asked for, and when: drafts while something moves, the full picture once all is still.
#pragma once

#include <chrono>
#include <memory>

#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

class Wishes {
 public:
  explicit Wishes(RenderWorker& worker) : worker_(worker) {}

  /// To be called each window frame; `holding`: a drag or a slider is under way.
  void update(const State& state, bool holding);
  /// Whether the worker's latest frame answers the latest state in full.
  bool settled(const Frame* frame) const {
    return frame && !moving_ && frame->number == asked_ && frame->final;
  }
  /// Whether a picture is still to be asked for.
  bool restless() const { return moving_; }

 private:
  void ask(const State& state, bool draft);

  RenderWorker& worker_;
  State shown_;              ///< as last asked for
  std::uint64_t asked_ = 0;  ///< number of the last job; 0: none yet
  bool moving_ = false;      ///< the last job asked for a draft, or a newer state waits
  std::chrono::steady_clock::time_point changed_{};
};

}  // namespace penumbra::viewer
