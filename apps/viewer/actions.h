// What writes a picture or a state at a key press.
#pragma once

#include <filesystem>
#include <string>

#include "apps/viewer/commands.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

struct ActionInput {
  const State& state;
  const Frame* frame;  ///< what is shown; may be null
  bool settled;        ///< and whether it is the full picture
  std::filesystem::path folder;
};
struct ActionResult {
  std::string message;  ///< a line to show
  bool saved_state = false;
};
/// Never throws for what can go wrong outside: the message says it.
ActionResult perform(Command command, const ActionInput& input);

}  // namespace penumbra::viewer
