// Embree's side of RayScene, for the sources of render/rays.
#pragma once

#include <embree3/rtcore.h>

#include "penumbra/mesh/error.h"
#include "render/rays/ray_scene.h"

namespace penumbra {

struct RayScene::Impl {
  Impl(const Scene& scene, const RayFrame& frame, tbb::task_arena& threads);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RTCDevice device = nullptr;
  RTCScene all = nullptr;      ///< what the camera sees
  RTCScene casters = nullptr;  ///< what hides the light
};

}  // namespace penumbra
