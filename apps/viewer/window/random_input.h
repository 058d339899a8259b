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
#include "apps/viewer/window/window.h"

namespace penumbra::viewer {

class RandomInput {
 public:
  /// For so many seconds; `files` are dropped now and then, and a path that does not exist.
  RandomInput(std::uint64_t seed, double seconds, std::vector<std::filesystem::path> files);
  /// Moves, clicks and types; sometimes resizes the window or drops a file on it. Once a window
  /// frame, before ImGui's frame begins. Returns a command to obey, or none.
  std::optional<Command> act(Window& window);
  /// After a third of the time and at its end the window rests: it is to show again what it showed at first,
  /// so that what it takes then can be compared.
  bool rests() const;
  /// Ends a rest: everything is shown and nothing else is going on.
  void note_memory();
  bool done() const { return mib_.size() == 2; }
  /// What was done, and how memory grew from one rest to the other.
  std::string summary() const;
  /// Whether the second rest took at most a half and 64 MiB more than the first.
  bool memory_stayed() const;

 private:
  int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
  void use_mouse(Window& window);

  using Clock = std::chrono::steady_clock;
  std::mt19937_64 engine_;
  double seconds_;
  std::vector<std::filesystem::path> files_;
  Clock::time_point start_ = Clock::now();
  Window::Hand hand_;
  int actions_ = 0;
  std::vector<double> mib_;  ///< one a rest
};

}  // namespace penumbra::viewer
