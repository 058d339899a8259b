// Work beside what the calling thread does by itself: OpenGL's calls above all, which belong to one thread.
#pragma once

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <utility>

namespace penumbra::detail {

/// Runs `body` on the arena's other threads, if it has any, and ends no later than this object does. Whoever
/// waits for it helps.
class Background {
 public:
  template <class Body>
  Background(tbb::task_arena& arena, Body body) : arena_(arena) {
    arena_.execute([&] { group_.run(std::move(body)); });
  }
  /// After an exception on the calling thread what `body` throws is of no more interest.
  ~Background() {
    try {
      wait();
    } catch (...) {
    }
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  /// Throws what `body` threw.
  void wait() {
    arena_.execute([&] { group_.wait(); });
  }

 private:
  tbb::task_arena& arena_;
  tbb::task_group group_;
};

}  // namespace penumbra::detail
