#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/cli/study/measure.h"

extern char** environ;

namespace penumbra::apps {
namespace {

std::vector<std::string> command_of(const std::string& scene_path, const StudyView& view,
                                    const Setting& setting) {
  std::vector<std::string> words{"penumbra",
                                 "render",
                                 scene_path,
                                 "--size",
                                 std::to_string(view.width) + "x" + std::to_string(view.height),
                                 "--method",
                                 setting.method,
                                 "--stats",
                                 "-"};
  for (const auto& [name, value] : setting.options) {
    words.push_back("--" + name);
    words.push_back(penumbra::to_text(value));
  }
  return words;
}

/// What the command prints; empty where it fails.
std::string output_of(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const bool started =
      posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part;
  for (ssize_t count = 0; started && (count = read(ends[0], part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  const bool fine =
      started && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return fine ? text : std::string();
}

}  // namespace

std::optional<double> peak_memory(const std::string& scene_path, const StudyView& view,
                                  const Setting& setting) {
  const auto stats = nlohmann::json::parse(output_of(command_of(scene_path, view, setting)), nullptr, false);
  if (stats.is_discarded() || !stats.contains("peak_memory_bytes")) return std::nullopt;
  return stats["peak_memory_bytes"].get<double>() / (1 << 20);
}

}  // namespace penumbra::apps
