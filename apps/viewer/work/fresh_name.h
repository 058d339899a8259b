// Names of files that the viewer saves: none of them is there yet.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

#include "apps/viewer/state/state.h"

namespace penumbra::viewer {

/// "STEM-001" of what is open, with the first number for which no file STEM-001END is in the folder, for any
/// of the ends.
std::string fresh_stem(const std::filesystem::path& folder, const State& state,
                       std::initializer_list<std::string> ends);

}  // namespace penumbra::viewer
