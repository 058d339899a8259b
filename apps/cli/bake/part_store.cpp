#include "apps/cli/bake/part_store.h"

#include <fstream>
#include <sstream>

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

}  // namespace

PartStore::PartStore(std::filesystem::path folder, const nlohmann::json& settings)
    : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error || !std::filesystem::is_directory(folder_, error))
    throw SystemError(folder_.string() + ": cannot be made a folder for parts; name another by --parts");
  bool is_mine = std::filesystem::is_empty(folder_, error), has_parts = false;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    is_mine = is_mine || entry.path() == settings_file();
    has_parts = has_parts || entry.path().extension() == kExtension;
  }
  if (!is_mine) throw UsageError(folder_.string() + ": is there and holds no parts; name another by --parts");
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
  std::filesystem::remove(folder_, ignored);
}

}  // namespace penumbra::apps
