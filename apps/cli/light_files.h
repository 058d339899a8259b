// Names of files where a scene has several lights.
#pragma once

#include <filesystem>
#include <string>

namespace penumbra::apps {

/// "u.ply" → "u.NAME.ply"; as it is where the scene has one light or one was chosen.
inline std::filesystem::path file_of_light(const std::filesystem::path& path, const std::string& light) {
  if (light.empty() || path.empty()) return path;
  std::filesystem::path named = path;
  return named.replace_filename(path.stem().string() + "." + light + path.extension().string());
}

}  // namespace penumbra::apps
