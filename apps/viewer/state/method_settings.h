// The settings of a method as names and words, taken from the command line's own options: what `penumbra
// render` knows, the viewer shows, and a state saved by one is understood by the other.
#pragma once

#include <string>
#include <vector>

#include "penumbra/render/renderer.h"

namespace penumbra::viewer {

struct Setting {
  std::string name;                ///< without dashes, such as "dbuffer-size"
  std::string value;               ///< as the command line would have it
  std::string usual;               ///< its default
  std::string help;                ///< one line
  std::string method;              ///< the method it belongs to; empty: any
  std::vector<std::string> words;  ///< what may be chosen; empty where a number is wanted
};

/// All settings of all methods.
std::vector<Setting> all_settings(const RenderOptions& options);
/// Those of options.method.
std::vector<Setting> settings_of(const RenderOptions& options);
/// Throws UsageError for a name or value the command line would refuse; `options` is then as it was.
void set(RenderOptions& options, const std::string& name, const std::string& value);
/// " --samples 64": settings of the method that differ from their defaults.
std::string settings_arguments(const RenderOptions& options);

}  // namespace penumbra::viewer
