// What the program says on standard error: one line at a time, and progress where somebody watches.
#pragma once

#include <chrono>
#include <string>

#include "penumbra/mesh/progress.h"

namespace penumbra::apps {

/// "penumbra: message", as one line whatever the message holds.
void complain(const std::string& message);

/// A warning that what was given has no effect, and why.
void say_ignored(const std::string& option, const std::string& why);

/// "rendering 42%, 12 s left": what is done of something that has taken so many seconds. No estimate where it
/// would be idle or a guess.
std::string progress_text(const std::string& label, double fraction, double seconds);

/// A percentage and an estimate that overwrite themselves, on a terminal only. Goes away when destroyed.
class ProgressLine {
 public:
  explicit ProgressLine(std::string label);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Shows the label alone, at once: for what does not tell how far it is.
  void begin();
  /// For long calls; must not be used after this object is gone. Empty where nobody watches.
  Progress callback();

 private:
  void show(double fraction);

  std::string label_;
  bool watched_;
  bool shown_ = false;
  double fraction_ = 0.0;
  std::chrono::steady_clock::time_point start_, next_;
};

}  // namespace penumbra::apps
