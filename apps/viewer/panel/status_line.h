// The line below picture and panel: the last message at the left, what is going on at the right. It is always
// there, so that nothing moves when there is something to say.
#pragma once

#include <string>

#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

/// What the picture is: "final picture", "full size" while something moves, "draft of 480 × 300, 1/2 of full
/// size"; how many rays; the error.
std::string picture_in_words(const Frame* frame, bool settled);

struct StatusLineInput {
  std::string message;  ///< the last thing worth saying
  std::string activity;
  int y, width, height;  ///< its place in the window
};
/// What does not fit is cut off; all of it is shown where the mouse is over it.
void draw_status_line(const StatusLineInput& input);

}  // namespace penumbra::viewer
