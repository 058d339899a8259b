#include "apps/cli/bake/part_store.h"

#include <fstream>
#include <sstream>
#include <vector>

#include "apps/common/outputs.h"
#include "mesh/io/write_file.h"
#include "penumbra/mesh/error.h"

namespace penumbra::apps {
namespace {

constexpr const char* kExtension = ".f32";

std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Left by a write that was killed (mesh/io/write_file.h).
bool is_unfinished(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(".penumbra-") && name.ends_with(".tmp");
}

/// Whether a file has the keys of such settings: of some bake, not of another program.
bool is_of_parts(const std::filesystem::path& file, const nlohmann::json& settings) {
  const auto found = nlohmann::json::parse(text_of_file(file), nullptr, false);
  if (!found.is_object()) return false;
  for (const auto& [key, value] : settings.items())
    if (!found.contains(key)) return false;
  return true;
}

}  // namespace

PartStore::PartStore(std::filesystem::path folder, const nlohmann::json& settings)
    : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error || !std::filesystem::is_directory(folder_, error))
    throw SystemError(folder_.string() + ": cannot be made a folder for parts; name another by --parts");
  bool is_empty = true, has_settings = false, has_parts = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (is_unfinished(entry.path())) continue;
    is_empty = false;
    has_settings = has_settings || entry.path() == settings_file();
    has_parts = has_parts || entry.path().extension() == kExtension;
  }
  if (!is_empty && !(has_settings && (has_parts || is_of_parts(settings_file(), settings))))
    throw UsageError(folder_.string() + ": is there and holds no parts; name another by --parts");
  if (!has_parts)
    write_json(settings_file(), settings);
  else if (text_of_file(settings_file()) != to_text(settings))
    throw UsageError(
        folder_.string() +
        ": holds parts of another scene or other options; remove it, or name another by --parts");
}

std::filesystem::path PartStore::file_of(std::size_t part) const {
  return folder_ / (std::to_string(part) + kExtension);
}

bool PartStore::has(std::size_t part, std::size_t values) const {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file_of(part), error);
  return !error && bytes == values * sizeof(float);
}

std::vector<float> PartStore::read(std::size_t part) const {
  const std::filesystem::path path = file_of(part);
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  std::vector<float> values(error ? 0 : bytes / sizeof(float));
  const auto size = static_cast<std::streamsize>(values.size() * sizeof(float));
  if (error || !in.read(reinterpret_cast<char*>(values.data()), size))
    throw SystemError(path.string() + ": cannot be read; remove it and bake again");
  return values;
}

void PartStore::write(std::size_t part, const std::vector<float>& values) const {
  write_file(file_of(part), [&](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(float)));
  });
}

void PartStore::remove(std::size_t parts) const {
  std::error_code ignored;
  for (std::size_t part = 0; part < parts; ++part) std::filesystem::remove(file_of(part), ignored);
  std::filesystem::remove(settings_file(), ignored);
  std::vector<std::filesystem::path> unfinished;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored))
    if (is_unfinished(entry.path())) unfinished.push_back(entry.path());
  for (const std::filesystem::path& file : unfinished) std::filesystem::remove(file, ignored);
  std::filesystem::remove(folder_, ignored);
}

}  // namespace penumbra::apps
