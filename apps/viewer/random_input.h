// --random-input: a seeded hand that does anything, for tests of robustness. What it does goes through the
// same queues as what a person does.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "apps/viewer/commands.h"
#include "apps/viewer/window.h"

namespace penumbra::viewer {

class RandomInput {
 public:
  /// For so many seconds; `files` are dropped now and then, and a path that does not exist.
  RandomInput(std::uint64_t seed, double seconds, std::vector<std::filesystem::path> files);
  /// Moves, clicks and types; sometimes resizes the window or drops a file on it. Once a window
  /// frame, before ImGui's frame begins. Returns a command to obey, or none.
  std::optional<Command> act(Window& window);
  bool done() const;
  /// What was done, and how memory grew between a third of the time and the end.
  std::string summary() const;
  /// Whether memory at the end is within a half and 64 MiB of that after a third.
  bool memory_stayed() const;

 private:
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  void use_mouse(Window& window);
  void note_memory();

  using Clock = std::chrono::steady_clock;
  std::mt19937_64 engine_;
  double seconds_;
  std::vector<std::filesystem::path> files_;
  Clock::time_point start_ = Clock::now();
  Window::Hand hand_;
  int actions_ = 0;
  double third_mib_ = 0.0, last_mib_ = 0.0;
};

}  // namespace penumbra::viewer
