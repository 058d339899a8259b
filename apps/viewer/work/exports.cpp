#include "apps/viewer/work/exports.h"

#include <chrono>
#include <cstdio>

#include "penumbra/mesh/error.h"

namespace penumbra::viewer {

Exports::~Exports() {
  cancel();
  if (task_.valid()) task_.wait();
}

std::string Exports::start(const Export& work, const std::filesystem::path& folder, const State& state) {
  if (task_.valid()) return "another export is still running; Esc gives it up";
  run_ = std::make_shared<Run>();
  run_->name = work.name;
  task_ = std::async(std::launch::async, [work = work.run, folder, state, run = run_, wake = wake_] {
    std::string line;
    try {
      line = work(folder, state, [&](double fraction) {
        run->fraction = fraction;
        return !run->cancelled;
      });
    } catch (const Cancelled&) {
      line = std::string("given up: ") + run->name;
    } catch (const std::exception& e) {
      line = e.what();
    }
    wake();
    return line;
  });
  return std::string("exporting ") + work.name + "; Esc gives it up";
}

void Exports::cancel() {
  if (run_) run_->cancelled = true;
}

std::string Exports::news() {
  const bool done = task_.valid() && task_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return done ? task_.get() : std::string();
}

std::string Exports::activity() const {
  if (!busy()) return {};
  char percent[16];
  std::snprintf(percent, sizeof percent, ": %.0f%%", 100.0 * run_->fraction);
  return std::string("exporting ") + run_->name + percent;
}

}  // namespace penumbra::viewer
