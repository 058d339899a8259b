// Long calls: without Python's lock, stopped by Ctrl-C, watched by a callable.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

#include "penumbra/mesh/progress.h"

namespace penumbra::python {

namespace detail {
void run_without_lock(const pybind11::object& watcher, const std::function<void(const Progress&)>& work);
}

/// Runs `work(progress)` on a thread of its own, without Python's lock, and returns what it returns.
/// Meanwhile the caller's thread looks every 20 ms whether a signal came, and calls `watcher(fraction)`
/// unless it is None. An exception of either (KeyboardInterrupt, say) stops the work at its next report of
/// progress, and is thrown. Where the watcher returns False the work is stopped, and Cancelled is thrown. To
/// be called with the lock.
template <class Work>
auto long_call(const pybind11::object& watcher, Work&& work) {
  std::optional<decltype(work(Progress{}))> result;
  detail::run_without_lock(watcher, [&](const Progress& progress) { result.emplace(work(progress)); });
  return std::move(*result);
}

}  // namespace penumbra::python
