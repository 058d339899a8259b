#include "apps/common/parse_errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "render/support/nearest_word.h"

namespace penumbra::apps {
namespace {

bool is_option(const std::string& word) {
  return word.size() > 1 && word.front() == '-';
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// With their hyphens.
std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

/// What no command or option takes; empty where there is nothing.
std::string unknown_word(const CLI::App& command, const std::vector<std::string>& left) {
  const auto option = std::ranges::find_if(left, is_option);
  if (option != left.end()) {
    const std::string name = option->substr(0, option->find('='));
    return "unknown option " + name + did_you_mean(name, options_of(command));
  }
  if (left.empty()) return {};
  if (command.get_subcommands({}).empty()) return "unexpected argument '" + left.front() + "'";
  return "unknown command '" + left.front() + "'" + did_you_mean(left.front(), commands_of(command)) +
         "; use one of " + listed(commands_of(command));
}

}  // namespace

std::string explain(const CLI::App& app, const CLI::ParseError& error,
                    const std::vector<std::string>& words) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  const CLI::App& command = parsed.empty() ? app : *parsed.front();
  const std::string help =
      "; see " + app.get_name() + (parsed.empty() ? "" : " " + command.get_name()) + " --help";
  // Without a command all words are left, and the parser has stopped at what it missed first.
  std::vector<std::string> left = app.remaining(true);
  if (parsed.empty() && !app.get_subcommands({}).empty()) left = words;
  const std::string unknown = unknown_word(command, left);
  return (unknown.empty() ? std::string(error.what()) : unknown) + help;
}

std::string require_one_of(const std::vector<std::string>& known, const std::string& word) {
  if (std::ranges::find(known, word) != known.end()) return {};
  return "'" + word + "' is not allowed" + did_you_mean(word, known) + "; give " + listed(known);
}

}  // namespace penumbra::apps
