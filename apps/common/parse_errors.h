// What to say of a command line that cannot be parsed.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace penumbra::apps {

/// One line: what is wrong, with the nearest known command or option where one is unknown, and which help to
/// read. `words` is the command line without the program's name, `app` has parsed it.
std::string explain(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words);

/// A check for options: one of these words, with the nearest one where it is none.
std::string require_one_of(const std::vector<std::string>& known, const std::string& word);

}  // namespace penumbra::apps
