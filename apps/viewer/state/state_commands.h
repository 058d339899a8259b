// Commands that change nothing but the state.
#pragma once

#include <string>

#include "apps/viewer/commands.h"
#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// The method `step` places further in the list, around its end.
std::string next_method(const std::string& method, int step);

/// Obeys and returns true, or returns false: the command is none of these.
bool change_state(State& state, Command command);

}  // namespace penumbra::viewer
