#include "apps/viewer/random_input.h"

#include <cstdio>

#include "apps/viewer/costs.h"

namespace penumbra::viewer {

RandomInput::RandomInput(std::uint64_t seed, double seconds, std::vector<std::filesystem::path> files)
    : engine_(seed), seconds_(seconds), files_(std::move(files)) {
  files_.emplace_back("no-such-file.json");
}

bool RandomInput::done() const {
  return Clock::now() - start_ > std::chrono::duration<double>(seconds_);
}

std::optional<Command> RandomInput::act(Window& window) {
  note_memory();
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
  last_mib_ = static_cast<double>(resident_bytes()) / (1 << 20);
  if (Clock::now() - start_ < std::chrono::duration<double>(seconds_ / 3.0)) third_mib_ = last_mib_;
}

bool RandomInput::memory_stayed() const {
  return last_mib_ < 1.5 * third_mib_ + 64.0;
}

std::string RandomInput::summary() const {
  char text[160];
  std::snprintf(text, sizeof text,
                "random input: %d actions; %.0f MiB after a third of the time, %.0f at the end", actions_,
                third_mib_, last_mib_);
  return text;
}

}  // namespace penumbra::viewer
