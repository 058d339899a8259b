#include "apps/common/outputs.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <iostream>

#include "apps/common/messages.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {

std::string shown_name(const std::filesystem::path& output) {
  return is_standard(output) ? "standard output" : output.string();
}

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void require_extension(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string_view>& known, bool stdout_allowed) {
  if (is_standard(path) && stdout_allowed) return;
  const std::string extension = extension_of(path);
  if (std::find(known.begin(), known.end(), extension) != known.end()) return;
  std::string list;
  for (std::string_view each : known) list += (list.empty() ? "" : " or ") + std::string(each);
  throw UsageError(option + " " + path.string() + ": must end in " + list);
}

void require_writable(const std::filesystem::path& path) {
  if (path.empty() || is_standard(path)) return;
  const auto fail = [&path](const std::string& reason) {
    throw SystemError(path.string() + ": cannot be written: " + reason);
  };
  const std::filesystem::path target = written_path(path);
  struct stat status;
  const bool exists = ::stat(target.c_str(), &status) == 0;
  if (!exists && errno == ENAMETOOLONG) fail("its name is too long; choose a shorter one");
  if (exists && S_ISDIR(status.st_mode)) fail("it is a folder; add a file name");
  if (exists && access(target.c_str(), W_OK) != 0) fail("no permission to replace it; choose another name");
  if (exists && !S_ISREG(status.st_mode)) return;
  std::filesystem::path folder = target.parent_path();
  if (folder.empty()) folder = ".";
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored))
    fail("folder " + folder.string() + " does not exist; create it");
  if (!std::filesystem::is_directory(folder, ignored))
    fail(folder.string() + " is no folder; choose another");
  if (access(folder.c_str(), W_OK) != 0)
    fail("no permission to write in " + folder.string() + "; choose another");
}

namespace {

/// What tells files apart: links and ".." are gone. Empty for what writing does not replace.
std::filesystem::path place_of(const std::filesystem::path& path) {
  if (path.empty() || is_standard(path)) return {};
  std::error_code error;
  const std::filesystem::path target = written_path(path);
  if (std::filesystem::is_other(target, error)) return {};
  const std::filesystem::path place = std::filesystem::weakly_canonical(target, error);
  return error ? std::filesystem::absolute(target, error).lexically_normal() : place;
}

}  // namespace

void require_apart(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::filesystem::path place = place_of(outputs[i].path);
    if (place.empty()) continue;
    for (const std::filesystem::path& input : inputs)
      if (place == place_of(input))
        throw UsageError(outputs[i].option + " " + outputs[i].path.string() + ": would replace the input " +
                         input.string() + "; choose another name");
    for (std::size_t k = 0; k < i; ++k)
      if (place == place_of(outputs[k].path))
        throw UsageError(outputs[k].option + " and " + outputs[i].option + " name the same file, " +
                         outputs[i].path.string() + "; choose two");
  }
}

void say_written(bool verbose, const std::filesystem::path& path) {
  if (!verbose) return;
  if (is_standard(path)) return complain("wrote to " + shown_name(path));
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  complain("wrote " + path.string() + (error ? "" : ", " + std::to_string(bytes) + " bytes"));
}

void require_one_stdout(const std::vector<std::filesystem::path>& paths) {
  if (std::count_if(paths.begin(), paths.end(), is_standard) > 1)
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
