#include "apps/python/long_call.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace penumbra::python::detail {
namespace {

namespace py = pybind11;

constexpr std::chrono::milliseconds kLook{20};

/// A thread that works, and what is said to it and by it.
class Worker {
 public:
  explicit Worker(const std::function<void(const Progress&)>& work)
      : thread_([this, work] {
          try {
            work([this](double fraction) {
              fraction_ = fraction;
              return !stop_;
            });
          } catch (...) {
            thrown_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          done_ = true;
          finished_.notify_all();
        }) {}
  ~Worker() { thread_.join(); }

  /// True where it has finished.
  bool wait() {
    std::unique_lock lock(mutex_);
    return finished_.wait_for(lock, kLook, [this] { return done_; });
  }
  void stop() { stop_ = true; }
  bool is_stopped() const { return stop_; }
  double fraction() const { return fraction_; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<double> fraction_{0.0};
  std::mutex mutex_;
  std::condition_variable finished_;
  bool done_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;  // last: it uses all others
};

/// With the lock. False: stop. Throws what a signal's handler or the watcher raises.
bool look(const py::object& watcher, double fraction) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return watcher.is_none() || !watcher(fraction).is(py::bool_(false));
}

}  // namespace

void run_without_lock(const py::object& watcher, const std::function<void(const Progress&)>& work) {
  std::exception_ptr raised;
  Worker worker(work);
  {
    const py::gil_scoped_release release;
    while (!worker.wait()) {
      if (worker.is_stopped()) continue;
      const py::gil_scoped_acquire acquire;
      try {
        if (!look(watcher, worker.fraction())) worker.stop();
      } catch (...) {
        raised = std::current_exception();
        worker.stop();
      }
    }
  }
  if (raised) std::rethrow_exception(raised);
  worker.rethrow();
  if (!watcher.is_none()) watcher(1.0);
}

}  // namespace penumbra::python::detail
