// Embree's side of RayScene, for the render sources that trace rays.
#pragma once

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include "mesh/error.h"
#include "render/ray_scene.h"

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
};

}  // namespace penumbra
