// Where results go: checks before any work is done, and writing of text and JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::apps {

/// Of inputs and outputs: standard input, standard output.
inline bool is_standard(const std::filesystem::path& path) {
  return path == "-";
}

/// For messages.
std::string shown_name(const std::filesystem::path& output);

/// In lower case, with the dot.
std::string extension_of(const std::filesystem::path& path);

/// Throws UsageError unless the extension is one of `known`, or the path is "-" and that is allowed.
void require_extension(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string_view>& known, bool stdout_allowed);

/// Throws SystemError where the file could not be created: no such folder, a folder itself, no permission, a
/// name that is too long. Finds before minutes of work what writing would find after them. Links are
/// followed. Empty paths and "-" pass.
void require_writable(const std::filesystem::path& path);

/// A file that a command writes, by which option.
struct Output {
  std::string option;
  std::filesystem::path path;
};

/// Throws UsageError where an output would replace one of the inputs, or another output, whatever links name
/// them. Empty paths, "-" and special files, such as /dev/null, pass.
void require_apart(const std::vector<Output>& outputs, const std::vector<std::filesystem::path>& inputs);

/// Says that the file was written, and its size, if `verbose`.
void say_written(bool verbose, const std::filesystem::path& path);

/// Throws UsageError where more than one of these is standard output. Empty paths are ignored.
void require_one_stdout(const std::vector<std::filesystem::path>& paths);

std::string to_text(
    const nlohmann::json& json);  ///< indented, names that are no UTF-8 made so, ends with a newline
void write_json(const std::filesystem::path& path, const nlohmann::json& json);
void print(const std::string& text);  ///< to standard output

}  // namespace penumbra::apps
