#include "apps/common/method_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

/// In their order.
std::vector<const MethodInfo*> find_methods_with(const std::string& option) {
  std::vector<const MethodInfo*> found;
  for (const MethodInfo& method : methods())
    if (std::ranges::find(method.options, option, &OptionSchema::name) != method.options.end())
      found.push_back(&method);
  return found;
}

/// The heading in --help: a method with its summary, or several names.
std::string group_of(const OptionSchema& option) {
  const std::vector<const MethodInfo*> with = find_methods_with(option.name);
  if (with.size() == 1) return "Method " + with.front()->name + ": " + with.front()->summary;
  return "Methods " + methods_with(option.name);
}

const char* type_of(const OptionSchema& option) {
  if (std::holds_alternative<WordChoice>(option.domain)) return "WORD";
  const auto* real = std::get_if<RealRange>(&option.domain);
  if (!real) return "N";
  return real->words.empty() ? "X" : "WORD|X";
}

}  // namespace

void add_method_options(CLI::App& command, OptionValues& values) {
  for (const OptionSchema& option : all_options()) {
    const std::string flag = "--" + option.name;
    const auto set = [&values, option, flag](const std::string& text) {
      try {
        values[option.name] = option.parse(text);
      } catch (const UsageError&) {
        throw CLI::ValidationError(flag, option.refusal(text));
      }
    };
    command.add_option_function<std::string>(flag, set, option.help + " (" + option.allowed() + ")")
        ->default_str(to_text(option.usual))
        ->type_name(type_of(option))
        ->group(group_of(option));
  }
}

std::string methods_with(const std::string& option) {
  const std::vector<const MethodInfo*> with = find_methods_with(option);
  std::string names;
  for (std::size_t i = 0; i < with.size(); ++i)
    names += (i == 0 ? "" : (i + 1 == with.size() ? " and " : ", ")) + with[i]->name;
  return names;
}

std::string method_words() {
  std::string words;
  for (const MethodInfo& method : methods()) words += (words.empty() ? "" : ", ") + method.name;
  return words;
}

}  // namespace penumbra::apps
