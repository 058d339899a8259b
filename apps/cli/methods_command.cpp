// penumbra methods: what there is to choose from, and every option of each.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/common/method_options.h"
#include "apps/common/outputs.h"
#include "penumbra/render/method.h"

namespace penumbra::apps {
namespace {

constexpr const char* kFooter = R"(Examples:
  penumbra methods
  penumbra methods --json
The options are those of penumbra render.)";

std::string lights_of(const MethodInfo& method) {
  std::string text;
  const auto add = [&](bool taken, const char* shape) {
    if (taken) text += (text.empty() ? "" : ", ") + std::string(shape);
  };
  add(method.takes_disks, "disk");
  add(method.takes_rectangles, "rectangle");
  add(method.takes_distant, "distant");
  return text;
}

std::string to_table() {
  std::string text;
  for (const MethodInfo& method : methods()) {
    text += method.name + (method.name == kMethodOfRender ? " (default)" : "") + ": " + method.summary + "\n";
    text += "  lights: " + lights_of(method) + (method.needs_opengl ? "; needs OpenGL" : "") +
            (method.certifies ? "; certifies" : "") + "\n";
    for (const OptionSchema& option : method.options)
      text += "  --" + option.name + " " + penumbra::to_text(option.usual) + "  " + option.help + " (" +
              option.allowed() + ")\n";
  }
  return text;
}

nlohmann::json to_json(const OptionSchema& option) {
  return {{"name", option.name},
          {"default", penumbra::to_text(option.usual)},
          {"allowed", option.allowed()},
          {"unit", option.unit},
          {"help", option.help}};
}

nlohmann::json to_json(const MethodInfo& method) {
  nlohmann::json options = nlohmann::json::array();
  for (const OptionSchema& option : method.options) options.push_back(to_json(option));
  return {{"name", method.name},
          {"default", method.name == kMethodOfRender},
          {"summary", method.summary},
          {"lights", lights_of(method)},
          {"needs_pixels", method.needs_pixels},
          {"needs_opengl", method.needs_opengl},
          {"certifies", method.certifies},
          {"options", options}};
}

}  // namespace

void add_methods_command(CLI::App& app) {
  CLI::App& command = *app.add_subcommand("methods", "The methods of render, and every option of each");
  auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "Print JSON");
  command.footer(kFooter);
  command.callback([json] {
    if (!*json) return print(to_table());
    nlohmann::json list = nlohmann::json::array();
    for (const MethodInfo& method : methods()) list.push_back(to_json(method));
    print(apps::to_text(list));
  });
}

}  // namespace penumbra::apps
