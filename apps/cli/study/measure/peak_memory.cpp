#include <nlohmann/json.hpp>
#include <vector>

#include "apps/cli/study/measure/measure.h"
#include "apps/cli/study/run_program.h"

namespace penumbra::apps {
namespace {

std::vector<std::string> command_of(const std::string& scene_path, const StudyView& view,
                                    const Setting& setting, int threads) {
  std::vector<std::string> words{"penumbra",
                                 "render",
                                 scene_path,
                                 "--size",
                                 std::to_string(view.width) + "x" + std::to_string(view.height),
                                 "--method",
                                 setting.method,
                                 "--antialias",
                                 "1",
                                 "--threads",
                                 std::to_string(threads),
                                 "--stats",
                                 "-"};
  for (const auto& [name, value] : setting.options) {
    words.push_back("--" + name);
    words.push_back(penumbra::to_text(value));
  }
  return words;
}

}  // namespace

std::optional<double> peak_memory(const std::string& scene_path, const StudyView& view,
                                  const Setting& setting, int threads) {
  const auto stats = nlohmann::json::parse(
      run_program("/proc/self/exe", command_of(scene_path, view, setting, threads), Stream::kOutput)
          .value_or(""),
      nullptr, false);
  if (stats.is_discarded() || !stats.contains("peak_memory_bytes")) return std::nullopt;
  return stats["peak_memory_bytes"].get<double>() / (1 << 20);
}

}  // namespace penumbra::apps
