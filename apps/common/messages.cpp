#include "apps/common/messages.h"

#include <unistd.h>

#include <cstdio>

namespace penumbra::apps {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(500);  // what is done sooner needs no progress
constexpr auto kPeriod = std::chrono::milliseconds(100);

}  // namespace

void complain(const std::string& message) {
  std::string line = "penumbra: " + message;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  std::fprintf(stderr, "%s\n", line.c_str());
}

void say_ignored(const std::string& option, const std::string& why) {
  complain("warning: " + option + " has no effect: " + why);
}

ProgressLine::ProgressLine(std::string label)
    : label_(std::move(label)),
      watched_(isatty(STDERR_FILENO) != 0),
      next_(std::chrono::steady_clock::now() + kPatience) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

Progress ProgressLine::callback() {
  if (!watched_) return {};
  return [this](double fraction) {
    show(fraction);
    return true;
  };
}

void ProgressLine::show(double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + kPeriod;
  shown_ = true;
  std::fprintf(stderr, "\r%s %3.0f%%\033[K", label_.c_str(), 100.0 * fraction);
  std::fflush(stderr);
}

}  // namespace penumbra::apps
