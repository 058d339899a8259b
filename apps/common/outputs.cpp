#include "apps/common/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <iostream>

#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void require_extension(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string_view>& known, bool stdout_allowed) {
  if (is_stdout(path) && stdout_allowed) return;
  const std::string extension = extension_of(path);
  if (std::find(known.begin(), known.end(), extension) != known.end()) return;
  std::string list;
  for (std::string_view each : known) list += (list.empty() ? "" : " or ") + std::string(each);
  throw UsageError(option + " " + path.string() + ": must end in " + list);
}

void require_writable(const std::filesystem::path& path) {
  if (path.empty() || is_stdout(path)) return;
  const auto fail = [&path](const std::string& reason) {
    throw SystemError(path.string() + ": cannot be written: " + reason);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail("it is a folder; add a file name");
  std::filesystem::path folder = path.parent_path();
  if (folder.empty()) folder = ".";
  if (!std::filesystem::exists(folder, ignored))
    fail("folder " + folder.string() + " does not exist; create it");
  if (!std::filesystem::is_directory(folder, ignored))
    fail(folder.string() + " is no folder; choose another");
  if (access(folder.c_str(), W_OK) != 0)
    fail("no permission to write in " + folder.string() + "; choose another");
}

void require_one_stdout(const std::vector<std::filesystem::path>& paths) {
  if (std::count_if(paths.begin(), paths.end(), is_stdout) > 1)
    throw UsageError("several results would go to standard output; name files for all but one");
}

std::string to_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_json(const std::filesystem::path& path, const nlohmann::json& json) {
  const std::string text = to_text(json);
  write_file(path, [&text](std::ostream& out) { out << text; });
}

void print(const std::string& text) {
  std::cout << text;
}

}  // namespace penumbra::apps
