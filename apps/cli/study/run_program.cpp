#include "apps/cli/study/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>

#include "apps/common/interrupts.h"

extern char** environ;

namespace penumbra::apps {
namespace {

std::atomic<pid_t> running{0};
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal handler reads it");

void kill_running() {
  if (const pid_t child = running) kill(child, SIGKILL);
}

/// Starts the program with one stream into the pipe and the other into nothing. 0 where that fails.
pid_t start(const std::string& program, std::vector<std::string>& words, Stream stream,
            const int (&ends)[2]) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int kept = static_cast<int>(stream), other = kept == STDOUT_FILENO ? STDERR_FILENO : STDOUT_FILENO;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], kept);
  posix_spawn_file_actions_addopen(&actions, other, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed == 0 ? child : 0;
}

/// All that can be read until the other end is closed. Nothing where that takes too long.
std::optional<std::string> read_all(int from, double most_seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(most_seconds);
  std::string text;
  std::array<char, 4096> part;
  while (true) {
    const std::chrono::duration<double, std::milli> left = end - Clock::now();
    pollfd waits{from, POLLIN, 0};
    const int ready = poll(&waits, 1, static_cast<int>(std::max(0.0, left.count())));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return std::nullopt;
    const ssize_t count = read(from, part.data(), part.size());
    if (count <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

std::optional<std::string> run_program(const std::string& program, std::vector<std::string> words,
                                       Stream stream, double most_seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  const pid_t child = start(program, words, stream, ends);
  close(ends[1]);
  std::optional<std::string> text;
  int status = 0;
  if (child != 0) {
    running = child;
    do_when_interrupted(kill_running);
    text = read_all(ends[0], most_seconds);
    if (!text) kill(child, SIGKILL);
    if (waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) text.reset();
    running = 0;  // it may close its stream long before it ends
  }
  close(ends[0]);
  return text;
}

}  // namespace penumbra::apps
