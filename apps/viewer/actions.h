// What writes a picture or a state at a key press. Each returns a line to show.
#pragma once

#include <filesystem>
#include <string>

#include "apps/viewer/commands.h"
#include "apps/viewer/state/state.h"
#include "apps/viewer/work/render_worker.h"

namespace penumbra::viewer {

/// The method `step` places further in the list, around its end.
std::string next_method(const std::string& method, int step);

struct ActionInput {
  const State& state;
  const Frame* frame;  ///< what is shown; may be null
  bool settled;        ///< and whether it is the full picture
  std::filesystem::path folder;
};
/// Never throws for what can go wrong outside: the line says it.
std::string perform(Command command, const ActionInput& input);

}  // namespace penumbra::viewer
