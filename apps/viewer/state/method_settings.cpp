#include "apps/viewer/state/method_settings.h"

#include <CLI/CLI.hpp>

#include "apps/common/method_options.h"
#include "penumbra/mesh/error.h"

namespace penumbra::viewer {
namespace {

// "Method dbuffer: what it is" → "dbuffer".
std::string method_in_group(const std::string& group) {
  for (const std::string& name : method_names())
    if (group.starts_with("Method " + name + ":")) return name;
  return {};
}

// "Which is kept (nearest, furthest)" → its words.
std::vector<std::string> words_in(const std::string& help) {
  std::vector<std::string> words;
  const auto open = help.rfind('('), close = help.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close < open) return words;
  std::string list = help.substr(open + 1, close - open - 1);
  for (std::size_t comma; (comma = list.find(", ")) != std::string::npos; list.erase(0, comma + 2))
    words.push_back(list.substr(0, comma));
  words.push_back(list);
  return words;
}

// An option's default string is the value that `options` had when it was added.
std::vector<Setting> list_of(RenderOptions options) {
  CLI::App app;
  app.set_help_flag();
  apps::add_method_options(app, options);
  std::vector<Setting> settings;
  for (const CLI::Option* option : app.get_options()) {
    Setting setting{.name = option->get_lnames().front(),
                    .value = option->get_default_str(),
                    .usual = {},
                    .help = option->get_description(),
                    .method = method_in_group(option->get_group()),
                    .words = {}};
    if (option->get_type_name() == "WORD") setting.words = words_in(setting.help);
    settings.push_back(std::move(setting));
  }
  return settings;
}

}  // namespace

std::vector<Setting> all_settings(const RenderOptions& options) {
  std::vector<Setting> settings = list_of(options);
  const std::vector<Setting> usual = list_of(RenderOptions{});
  for (std::size_t i = 0; i < settings.size(); ++i) settings[i].usual = usual[i].value;
  return settings;
}

std::vector<Setting> settings_of(const RenderOptions& options) {
  std::vector<Setting> settings = all_settings(options);
  std::erase_if(settings, [&](const Setting& each) {
    return !each.method.empty() && each.method != name_of(options.method);
  });
  return settings;
}

void set(RenderOptions& options, const std::string& name, const std::string& value) {
  RenderOptions changed = options;
  CLI::App app;
  app.set_help_flag();
  apps::add_method_options(app, changed);
  try {
    app.parse(std::vector<std::string>{"--" + name + "=" + value});
  } catch (const CLI::ParseError& e) {
    throw UsageError(e.what());
  }
  options = changed;
}

std::string settings_arguments(const RenderOptions& options) {
  std::string text;
  for (const Setting& each : settings_of(options))
    if (each.value != each.usual) text += " --" + each.name + " " + each.value;
  return text;
}

}  // namespace penumbra::viewer
