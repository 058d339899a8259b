#include "render/silhouette/edge_hierarchies.h"

#include <chrono>

namespace penumbra::detail {

template <class T, class Make>
const T& EdgeHierarchies::once(std::unique_ptr<T>& made, tbb::task_arena& threads, const Make& make) {
  if (made) return *made;
  const auto start = std::chrono::steady_clock::now();
  threads.execute([&] { made = make(); });
  milliseconds_ +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return *made;
}

const SceneEdges& EdgeHierarchies::edges(tbb::task_arena& threads) {
  return once(edges_, threads,
              [&] { return std::make_unique<SceneEdges>(scene_, frame_.origin, frame_.scale); });
}

const MergedEdges& EdgeHierarchies::merged(tbb::task_arena& threads) {
  return once(merged_, threads,
              [&] { return std::make_unique<MergedEdges>(scene_, frame_.origin, frame_.scale); });
}

const CasterBoxes& EdgeHierarchies::boxes(tbb::task_arena& threads) {
  return once(boxes_, threads, [&] { return std::make_unique<CasterBoxes>(scene_); });
}

const BoxedGroups& EdgeHierarchies::groups(const Receivers& receivers, tbb::task_arena& threads) {
  if (taken_) return *taken_;
  if (groups_ && receivers.revision != 0 && receivers.revision == revision_) return *groups_;
  threads.execute([&] { groups_ = std::make_unique<BoxedGroups>(receivers); });
  revision_ = receivers.revision;
  ++groupings_;
  return *groups_;
}

}  // namespace penumbra::detail
