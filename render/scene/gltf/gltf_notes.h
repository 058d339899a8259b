// What a glTF file has and a scene does not: said once each, in one line.
#pragma once

#include <set>
#include <string>

namespace penumbra::detail {

class GltfNotes {
 public:
  void ignore(const std::string& what) { ignored_.insert(what); }
  /// "ignored its animations, textures"; empty where nothing was.
  std::string text() const {
    std::string text;
    for (const std::string& what : ignored_) text += (text.empty() ? "ignored its " : ", ") + what;
    return text;
  }

 private:
  std::set<std::string> ignored_;
};

}  // namespace penumbra::detail
