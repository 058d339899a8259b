// Silhouette method, step edges, for other methods: the hierarchy over all edges of the casters, made once.
#pragma once

#include <tbb/task_arena.h>

#include <optional>

#include "render/scene/ray_frame.h"
#include "render/silhouette/edges/scene_edges.h"

namespace penumbra::detail {

/// In the frame of rays, made when it is first asked for. Not for several threads at once.
class EdgesOfScene {
 public:
  /// Refers to the scene.
  explicit EdgesOfScene(const Scene& scene) : scene_(scene) {}

  const SceneEdges& made(tbb::task_arena& threads) {
    if (!edges_)
      threads.execute([&] {
        const RayFrame frame = ray_frame(scene_);
        edges_.emplace(scene_, frame.origin, frame.scale);
      });
    return *edges_;
  }

 private:
  const Scene& scene_;
  std::optional<SceneEdges> edges_;
};

}  // namespace penumbra::detail
