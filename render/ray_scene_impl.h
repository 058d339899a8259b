// Embree's side of RayScene, for the render sources that trace rays.
#pragma once

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <memory>
#include <mutex>

#include "mesh/error.h"
#include "render/ray_scene.h"
#include "render/scene_edges.h"

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

  /// Made when it is first asked for.
  const detail::SceneEdges& edges() const;
  double edges_ms() const { return edges_ms_; }

 private:
  Scene scene_;  ///< meshes are shared with the caller's
  RayFrame frame_;
  mutable std::once_flag edges_once_;
  mutable std::unique_ptr<detail::SceneEdges> edges_;
  mutable double edges_ms_ = 0.0;
};

}  // namespace penumbra
