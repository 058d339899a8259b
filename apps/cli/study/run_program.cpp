#include "apps/cli/study/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

extern char** environ;

namespace penumbra::apps {
namespace {

/// Starts the program with one stream into the pipe and the other into nothing. 0 where that fails.
pid_t start(const std::string& program, std::vector<std::string>& words, Stream stream,
            const int (&ends)[2]) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int kept = static_cast<int>(stream), other = kept == STDOUT_FILENO ? STDERR_FILENO : STDOUT_FILENO;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], kept);
  posix_spawn_file_actions_addopen(&actions, other, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? child : 0;
}

}  // namespace

std::optional<std::string> run_program(const std::string& program, std::vector<std::string> words,
                                       Stream stream) {
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  const pid_t child = start(program, words, stream, ends);
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part;
  for (ssize_t count = 0; child != 0 && (count = read(ends[0], part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  if (child == 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return std::nullopt;
  return text;
}

}  // namespace penumbra::apps
