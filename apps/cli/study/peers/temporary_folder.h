// study --peers: a folder for what other programs read and write.
#pragma once

#include <filesystem>
#include <string>

namespace penumbra::apps {

/// Removed with all it holds.
class TemporaryFolder {
 public:
  /// Throws SystemError.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace penumbra::apps
