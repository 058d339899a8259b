// bake: values of parts in a folder, so that what was done once is not done again.
//
//   DIR/settings.json   what the values belong to
//   DIR/NUMBER.f32      values of a part, float32, little endian
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace penumbra::apps {

class PartStore {
 public:
  /// Makes the folder, or goes on in it. Throws UsageError where it belongs to other settings or holds
  /// something else, SystemError where it cannot be written.
  PartStore(std::filesystem::path folder, const nlohmann::json& settings);

  /// Whether a file of that many values is there.
  bool has(std::size_t part, std::size_t values) const;
  /// Throws SystemError where it cannot be read.
  std::vector<float> read(std::size_t part) const;
  /// Whole or not at all.
  void write(std::size_t part, const std::vector<float>& values) const;
  /// Takes away the files of so many parts, the settings, and the folder if nothing else is in it.
  void remove(std::size_t parts) const;

 private:
  std::filesystem::path file_of(std::size_t part) const;
  std::filesystem::path settings_file() const { return folder_ / "settings.json"; }

  std::filesystem::path folder_;
};

}  // namespace penumbra::apps
