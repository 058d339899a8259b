// Undo and redo: the states that were, each as it was.
//
// A step is what one gesture did: a drag, a slider, a key. Camera movements that follow one another are one
// step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// What differs between two states, in words: "light", "camera", "method" or "overlays"; empty where a step
/// would change nothing.
std::string difference_in_words(const State& a, const State& b);

class History {
 public:
  /// Forgets all steps: another scene was opened.
  void begin(const State& state);
  /// To be told of the state whenever no gesture is under way.
  void note(const State& state);
  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < states_.size(); }
  /// Changes `state` to what it was before the last step, but for the window's size. What was undone, in
  /// words.
  std::string undo(State& state) { return go(state, -1); }
  std::string redo(State& state) { return go(state, 1); }

 private:
  static constexpr std::size_t kMost = 200;  // steps; a state shares its model
  std::string go(State& state, int step);

  std::vector<State> states_;  ///< the first one has no step before it
  std::size_t at_ = 0;         ///< that of now
};

}  // namespace penumbra::viewer
