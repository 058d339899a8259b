// The settings of methods as names and texts, from the registry: what `penumbra render` takes, the viewer
// shows, and a state saved by one is understood by the other.
#pragma once

#include <string>

#include "penumbra/render/renderer.h"

namespace penumbra::viewer {

/// What an option of the method is now, as a text.
std::string value_of(const RenderOptions& options, const OptionSchema& option);
/// Of any method's option. Throws UsageError for a name that no method has or a value that it does not allow;
/// `options` is then as it was.
void set(RenderOptions& options, const std::string& name, const std::string& value);
/// " --samples 64": settings of the method that differ from their defaults.
std::string settings_arguments(const RenderOptions& options);
/// The words or numbers that may be chosen; empty where a number is to be typed.
std::vector<std::string> choices_of(const OptionSchema& option);

}  // namespace penumbra::viewer
