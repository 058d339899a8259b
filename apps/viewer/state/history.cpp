#include "apps/viewer/state/history.h"

namespace penumbra::viewer {
namespace {

bool same_methods(const State& a, const State& b) {
  const auto same = [](const RenderOptions& x, const RenderOptions& y) {
    return x.method == y.method && x.options == y.options;
  };
  return same(a.left, b.left) && same(a.right, b.right) && a.arrangement == b.arrangement &&
         a.shown == b.shown && a.divider == b.divider && a.exposure == b.exposure &&
         a.difference_scale == b.difference_scale;
}

bool same_overlays(const State& a, const State& b) {
  return a.overlays == b.overlays && a.probe == b.probe;
}

// The window's size stays; a new revision makes the picture anew.
void restore(const State& then, State& now) {
  const int width = now.left.width, height = now.left.height, revision = now.revision + 1;
  now = then;
  now.left.width = now.right.width = width;
  now.left.height = now.right.height = height;
  now.revision = revision;
}

}  // namespace

std::string difference_in_words(const State& a, const State& b) {
  if (a.lights != b.lights || a.selected != b.selected || a.aim != b.aim) return "light";
  if (!same_methods(a, b)) return "method";
  if (!same_overlays(a, b)) return "overlays";
  return a.camera == b.camera ? "" : "camera";
}

void History::begin(const State& state) {
  states_ = {state};
  at_ = 0;
}

void History::note(const State& state) {
  const std::string what = difference_in_words(states_[at_], state);
  if (what.empty()) return;
  states_.resize(at_ + 1);
  if (what == "camera" && at_ > 0 && difference_in_words(states_[at_ - 1], states_[at_]) == "camera") {
    states_[at_] = state;
    return;
  }
  states_.push_back(state);
  if (states_.size() > kMost) states_.erase(states_.begin());
  at_ = states_.size() - 1;
}

std::string History::go(State& state, int step) {
  if (step < 0 ? !can_undo() : !can_redo()) return {};
  const std::size_t to = at_ + static_cast<std::size_t>(step);
  const std::string what = difference_in_words(states_[at_], states_[to]);
  at_ = to;
  restore(states_[at_], state);
  return what;
}

}  // namespace penumbra::viewer
