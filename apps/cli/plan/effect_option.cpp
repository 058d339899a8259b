#include "apps/cli/plan/effect_option.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace penumbra::apps {
namespace {

std::string effect_words() {
  std::string words;
  for (const EffectName& effect : kEffects) words += (words.empty() ? "" : ", ") + std::string(effect.name);
  return words;
}

using Set = std::function<void(const EffectName& effect, EffectChoice choice)>;

void set_effect(const std::string& text, const Set& set) {
  const std::size_t sign = text.find('=');
  const std::string name = text.substr(0, sign),
                    word = sign == std::string::npos ? "" : text.substr(sign + 1);
  for (const EffectName& effect : kEffects)
    if (name == effect.name && (word == "on" || word == "off"))
      return set(effect, word == "on" ? EffectChoice::kOn : EffectChoice::kOff);
  throw CLI::ValidationError(
      "--effect", "'" + text + "' is not allowed; give NAME=on or NAME=off with one of " + effect_words());
}

void add(CLI::App& command, const Set& set) {
  command
      .add_option_function<std::vector<std::string>>(
          "--effect",
          [set](const std::vector<std::string>& all) {
            for (const std::string& text : all) set_effect(text, set);
          },
          "Method auto: do this or leave it out, whatever the plan would say; may be repeated (" +
              effect_words() + ")")
      ->allow_extra_args(false)
      ->type_name("NAME=on|off");
}

}  // namespace

void add_effect_option(CLI::App& command, OptionValues& values) {
  add(command, [&values](const EffectName& effect, EffectChoice choice) {
    values[std::string("effect-") + effect.name] = std::string(choice == EffectChoice::kOn ? "on" : "off");
  });
}

void add_effect_option(CLI::App& command, Effects& effects) {
  add(command,
      [&effects](const EffectName& effect, EffectChoice choice) { effects.*effect.member = choice; });
}

}  // namespace penumbra::apps
