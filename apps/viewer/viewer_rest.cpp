#include <utility>

#include "apps/viewer/viewer.h"

namespace penumbra::viewer {

void Viewer::play() {
  if (!options_.drop.empty() && settled()) window_.drop(std::exchange(options_.drop, {}));
  if (!random_input_) return;
  frames_to_draw_ = 1;
  if (random_input_->rests()) return rest();
  if (const auto command = random_input_->act(window_)) obey(*command);
}

// Back to what was shown at first; once all of it is there, what it takes is noted.
void Viewer::rest() {
  if (std::exchange(goes_to_rest_, false)) {
    window_.use_hand({});
    window_.set_size(options_.width + (options_.plain ? 0 : window_.look().panel_width()),
                     options_.height + (options_.plain ? 0 : window_.look().status_height()));
    const int revision = state().revision + 1;
    state() = first_;
    state().revision = revision;
    document_.begin();
    show_panel_ = !options_.plain;
    show_help_ = false;
    browser_.hide();
    question_.hide();
    rested_frames_ = 0;
  }
  const bool busy = canvas_.busy() || exports_.busy();
  rested_frames_ = settled() && !busy && state().left.width == options_.width ? rested_frames_ + 1 : 0;
  if (rested_frames_ < 10) return;
  random_input_->note_memory();
  goes_to_rest_ = true;
  if (random_input_->done()) leaving_ = true;
}

}  // namespace penumbra::viewer
