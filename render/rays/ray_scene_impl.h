// Embree's side of RayScene, for the render sources that trace rays.
#pragma once

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <memory>
#include <mutex>

#include "penumbra/mesh/error.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/merge/merged_edges.h"

namespace penumbra {

/// 0 means all cores.
inline int thread_count(int threads) {
  return threads > 0 ? threads : tbb::task_arena::automatic;
}

struct RayScene::Impl {
  Impl(const Scene& scene, const RayFrame& frame, int threads);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RTCDevice device = nullptr;
  RTCScene all = nullptr;      ///< what the camera sees
  RTCScene casters = nullptr;  ///< what hides the light
  mutable tbb::task_arena arena;

  /// Both made when they are first asked for.
  const detail::SceneEdges& edges() const;
  const detail::MergedEdges& merged_edges() const;
  /// What making them took, so far.
  double edges_ms() const { return edges_.milliseconds + merged_edges_.milliseconds; }

 private:
  template <class T>
  struct OnDemand {
    std::once_flag once;
    std::unique_ptr<T> made;
    double milliseconds = 0.0;
  };
  template <class T>
  const T& once(OnDemand<T>& of) const;

  Scene scene_;  ///< meshes are shared with the caller's
  RayFrame frame_;
  mutable OnDemand<detail::SceneEdges> edges_;
  mutable OnDemand<detail::MergedEdges> merged_edges_;
};

}  // namespace penumbra
