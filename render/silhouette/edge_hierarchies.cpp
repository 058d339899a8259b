#include "render/silhouette/edge_hierarchies.h"

#include <chrono>

namespace penumbra::detail {

template <class T>
const T& EdgeHierarchies::once(std::unique_ptr<T>& made, tbb::task_arena& threads) {
  if (made) return *made;
  const auto start = std::chrono::steady_clock::now();
  threads.execute([&] { made = std::make_unique<T>(scene_, frame_.origin, frame_.scale); });
  milliseconds_ +=
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return *made;
}

template const SceneEdges& EdgeHierarchies::once(std::unique_ptr<SceneEdges>&, tbb::task_arena&);
template const MergedEdges& EdgeHierarchies::once(std::unique_ptr<MergedEdges>&, tbb::task_arena&);

}  // namespace penumbra::detail
