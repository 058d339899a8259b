// The threads that a call may use, shared by everything that works for it.
#pragma once

#include <tbb/task_arena.h>

#include <memory>

namespace penumbra::detail {

using Threads = std::shared_ptr<tbb::task_arena>;

/// `count` threads; 0: all cores.
inline Threads make_threads(int count) {
  const int all = tbb::task_arena::automatic;
  return std::make_shared<tbb::task_arena>(count > 0 ? count : all);
}

}  // namespace penumbra::detail
