// The silhouette method's hierarchies over edges of casters, which serve every light.
#pragma once

#include <memory>

#include "render/rays/ray_scene.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/merge/merged_edges.h"

namespace penumbra::detail {

/// Of a scene's casters, in the frame of rays. Each is made when it is first asked for, on the threads that are given.
/// Not for several threads at once.
class EdgeHierarchies {
 public:
  /// Refers to the scene.
  explicit EdgeHierarchies(const Scene& scene) : scene_(scene), frame_(ray_frame(scene)) {}

  const RayFrame& frame() const { return frame_; }
  const SceneEdges& edges(tbb::task_arena& threads) { return once(edges_, threads); }
  const MergedEdges& merged(tbb::task_arena& threads) { return once(merged_, threads); }
  /// What making them took so far.
  double milliseconds() const { return milliseconds_; }
  std::size_t bytes() const { return (edges_ ? edges_->bytes() : 0) + (merged_ ? merged_->bytes() : 0); }

 private:
  template <class T>
  const T& once(std::unique_ptr<T>& made, tbb::task_arena& threads);

  const Scene& scene_;
  RayFrame frame_;
  double milliseconds_ = 0.0;
  std::unique_ptr<SceneEdges> edges_;
  std::unique_ptr<MergedEdges> merged_;
};

}  // namespace penumbra::detail
