// The scene as Embree sees it: what casts, for rays to lights, and all of it for what a camera sees.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <span>

#include "penumbra/render/scene/scene.h"
#include "render/scene/ray_frame.h"
#include "render/support/threads.h"

namespace penumbra {

/// Embree's hierarchies over a scene's objects, in one group of similar size or several (ray_groups.h), each
/// in a frame of its own. They serve every light. Meshes are shared, not copied.
class RayScene {
 public:
  RayScene(const Scene& scene, detail::Threads threads);
  /// On threads of its own (0: all cores).
  RayScene(const Scene& scene, int threads);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// About all casters (ray_frame).
  const RayFrame& frame() const { return frame_; }
  /// The threads that its callers work on.
  tbb::task_arena& arena() const { return *threads_; }
  double build_ms() const { return build_ms_; }

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  RayFrame frame_;
  detail::Threads threads_;
  double build_ms_ = 0.0;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
