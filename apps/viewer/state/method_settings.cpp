#include "apps/viewer/state/method_settings.h"

#include "penumbra/mesh/error.h"

namespace penumbra::viewer {

std::string value_of(const RenderOptions& options, const OptionSchema& option) {
  const auto given = options.options.find(option.name);
  return to_text(given == options.options.end() ? option.usual : given->second);
}

void set(RenderOptions& options, const std::string& name, const std::string& value) {
  for (const OptionSchema& option : all_options()) {
    if (option.name != name) continue;
    options.options[name] = option.parse(value);
    return;
  }
  throw UsageError("no method has an option " + name);
}

std::string settings_arguments(const RenderOptions& options) {
  std::string text;
  for (const OptionSchema& option : method_named(options.method).options) {
    const std::string value = value_of(options, option);
    if (value != to_text(option.usual)) text += " --" + option.name + " " + value;
  }
  return text;
}

std::vector<std::string> choices_of(const OptionSchema& option) {
  if (const auto* words = std::get_if<WordChoice>(&option.domain)) return words->words;
  std::vector<std::string> choices;
  if (const auto* numbers = std::get_if<IntegerChoice>(&option.domain))
    for (const std::uint64_t number : numbers->values) choices.push_back(to_text(number));
  return choices;
}

}  // namespace penumbra::viewer
