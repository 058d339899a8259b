// The options of every method on a command line, as their schemas say.
#pragma once

#include <string>

#include "penumbra/render/method.h"

namespace CLI {
class App;
}

namespace penumbra::apps {

/// The method of `penumbra render` where none is named.
inline constexpr const char* kMethodOfRender = "auto";

/// Adds every option of every method, in a group for each set of methods that has it. What is given goes into
/// `values`, which must outlive the command. Options of methods that are not used have no effect.
void add_method_options(CLI::App& command, OptionValues& values);

/// "rays and reference": the methods that have an option of this name.
std::string methods_with(const std::string& option);

/// "silhouette, reference, ...": what --method takes.
std::string method_words();

}  // namespace penumbra::apps
