// What the silhouette method keeps from call to call: hierarchies over edges of casters, which serve every
// light, and receivers in groups, which serve it while they stay.
#pragma once

#include <cstdint>
#include <memory>

#include "render/rays/ray_scene.h"
#include "render/receivers/receiver_box.h"
#include "render/silhouette/caster_boxes.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/merge/merged_edges.h"

namespace penumbra::detail {

/// Of a scene's casters, in the frame of rays. Each is made when it is first asked for, on the threads that
/// are given. Not for several threads at once.
class EdgeHierarchies {
 public:
  /// Refers to the scene.
  explicit EdgeHierarchies(const Scene& scene) : scene_(scene), frame_(ray_frame(scene)) {}

  const RayFrame& frame() const { return frame_; }
  const SceneEdges& edges(tbb::task_arena& threads);
  const MergedEdges& merged(tbb::task_arena& threads);
  const CasterBoxes& boxes(tbb::task_arena& threads);
  /// Groups that a caller has made, for the next call of groups(), or nullptr. They stay the caller's.
  void take_groups(const BoxedGroups* made) { taken_ = made; }
  /// The receivers in groups: those that were taken, else those of the call before where their revision is
  /// the same and not 0.
  const BoxedGroups& groups(const Receivers& receivers, tbb::task_arena& threads);
  /// How often groups have been made.
  std::size_t groupings() const { return groupings_; }
  void forget_receivers() { groups_.reset(); }
  /// What making the hierarchies took so far.
  double milliseconds() const { return milliseconds_; }
  std::size_t bytes() const { return (edges_ ? edges_->bytes() : 0) + (merged_ ? merged_->bytes() : 0); }

 private:
  template <class T, class Make>
  const T& once(std::unique_ptr<T>& made, tbb::task_arena& threads, const Make& make);

  const Scene& scene_;
  RayFrame frame_;
  double milliseconds_ = 0.0;
  std::unique_ptr<SceneEdges> edges_;
  std::unique_ptr<MergedEdges> merged_;
  std::unique_ptr<CasterBoxes> boxes_;
  std::unique_ptr<BoxedGroups> groups_;
  const BoxedGroups* taken_ = nullptr;
  std::uint64_t revision_ = 0;
  std::size_t groupings_ = 0;
};

}  // namespace penumbra::detail
