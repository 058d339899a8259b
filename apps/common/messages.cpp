#include "apps/common/messages.h"

#include <unistd.h>

#include <cmath>
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

std::string progress_text(const std::string& label, double fraction, double seconds) {
  char percent[16];
  std::snprintf(percent, sizeof percent, " %3.0f%%", 100.0 * fraction);
  const double left = seconds * (1.0 - fraction) / fraction;
  if (!(fraction >= 0.01) || seconds < 1.0 || left < 0.5) return label + percent;
  const bool in_minutes = left >= 99.5;
  return label + percent + ", " + std::to_string(std::lround(in_minutes ? left / 60.0 : left)) +
         (in_minutes ? " min left" : " s left");
}

ProgressLine::ProgressLine(std::string label)
    : label_(std::move(label)),
      watched_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      next_(start_ + kPatience) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::begin() {
  if (!watched_) return;
  shown_ = true;
  std::fprintf(stderr, "\r%s\033[K", label_.c_str());
  std::fflush(stderr);
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
  if (fraction < fraction_) start_ = now;  // another one of several
  fraction_ = fraction;
  if (now < next_) return;
  next_ = now + kPeriod;
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r%s\033[K", progress_text(label_, fraction, seconds).c_str());
  std::fflush(stderr);
}

}  // namespace penumbra::apps
