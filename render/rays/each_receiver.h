// How receivers are shared among threads.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "penumbra/mesh/error.h"
#include "penumbra/mesh/progress.h"

namespace penumbra::detail {

/// Runs `body(b)` for b = 0 ... blocks - 1 on the threads, and reports progress after every 16. Throws
/// Cancelled.
template <class Body>
void for_each_block(tbb::task_arena& threads, std::size_t blocks, const Progress& progress,
                    const Body& body) {
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stop{false};
  std::mutex reporting;
  threads.execute([&] {
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
      if (stop) return;
      body(b);
      if (++done % 16 != 0 || !progress) return;
      const std::unique_lock lock(reporting, std::try_to_lock);
      if (lock && !progress(static_cast<double>(done) / static_cast<double>(blocks))) stop = true;
    });
  });
  if (stop) throw Cancelled();
}

/// Runs `body(i)` for i = 0 ... count - 1 on the threads, in blocks, and reports progress. Throws Cancelled.
template <class Body>
void for_each_receiver(tbb::task_arena& threads, std::size_t count, const Progress& progress,
                       const Body& body) {
  constexpr std::size_t kBlock = 256;
  for_each_block(threads, (count + kBlock - 1) / kBlock, progress, [&](std::size_t b) {
    for (std::size_t i = b * kBlock; i < std::min(count, (b + 1) * kBlock); ++i) body(i);
  });
}

}  // namespace penumbra::detail
