#include "apps/viewer/window/random_input.h"

#include <malloc.h>

#include <cstdio>

#include "apps/viewer/work/costs.h"

namespace penumbra::viewer {

RandomInput::RandomInput(std::uint64_t seed, double seconds, std::vector<std::filesystem::path> files)
    : engine_(seed), seconds_(seconds), files_(std::move(files)) {
  files_.emplace_back("no-such-file.json");
}

bool RandomInput::rests() const {
  const double part = mib_.empty() ? 1.0 / 3.0 : 1.0;
  return Clock::now() - start_ > std::chrono::duration<double>(part * seconds_);
}

std::optional<Command> RandomInput::act(Window& window) {
  ++actions_;
  use_mouse(window);
  if (below(300) == 0) window.set_size(200 + below(1000), 100 + below(700));
  if (below(200) == 0)
    window.drop({files_[static_cast<std::size_t>(below(static_cast<int>(files_.size())))]});
  if (below(15) != 0) return std::nullopt;
  const auto keys = command_keys();
  const Command command = keys[static_cast<std::size_t>(below(static_cast<int>(keys.size())))].command;
  // It stays until its time is over, and a sequence alone would take all of it.
  const bool left_out = command == Command::kLeave || command == Command::kExportSequence;
  return left_out ? std::nullopt : std::optional(command);
}

void RandomInput::use_mouse(Window& window) {
  const auto [width, height] = window.size();
  const bool jump = below(4) == 0;
  hand_.x = static_cast<float>(jump ? below(width + 20) - 10 : static_cast<int>(hand_.x) + below(41) - 20);
  hand_.y = static_cast<float>(jump ? below(height + 20) - 10 : static_cast<int>(hand_.y) + below(41) - 20);
  if (below(5) == 0) {
    bool& down = hand_.down[below(3)];
    down = !down;
  }
  hand_.wheel = below(12) == 0 ? static_cast<float>(below(7) - 3) : 0.0f;
  if (below(20) == 0) hand_.shift = !hand_.shift;
  hand_.enter = below(40) == 0;
  hand_.character = below(20) == 0 ? static_cast<unsigned>(32 + below(95)) : 0u;
  window.use_hand(hand_);
}

void RandomInput::note_memory() {
  malloc_trim(0);
  mib_.push_back(static_cast<double>(resident_bytes()) / (1 << 20));
}

bool RandomInput::memory_stayed() const {
  return done() && mib_[1] < 1.5 * mib_[0] + 64.0;
}

std::string RandomInput::summary() const {
  if (!done()) return "random input: closed before its end";
  char text[160];
  std::snprintf(text, sizeof text,
                "random input: %d actions; %.0f MiB after a third of the time, %.0f at the end, both at rest",
                actions_, mib_[0], mib_[1]);
  return text;
}

}  // namespace penumbra::viewer
