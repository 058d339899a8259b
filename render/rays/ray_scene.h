// The scene as Embree sees it: rays for the surface buffer and occlusion rays for the reference.
//
// Float rays need a frame: everything is moved to the light's centre and scaled by a power of two to about
// unit size, so that float keeps its digits where shadows are decided (`RayFrame`).
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <span>

#include "penumbra/render/scene/scene.h"
#include "render/support/threads.h"

namespace penumbra {

/// local = (world - origin) · scale; scale is a power of two, so that only the translation rounds.
struct RayFrame {
  Vec3 origin{0.0};
  double scale = 1.0;
  bool operator==(const RayFrame&) const = default;
  Vec3 to_local(const Vec3& world) const { return (world - origin) * scale; }
};

/// The frame of objects under a light: origin at the light, bounds of objects and light scaled into [-1, 1].
RayFrame ray_frame(const Scene& scene, const LightShape& light);
/// The same under the scene's first light; about the objects where it has none.
RayFrame ray_frame(const Scene& scene);

/// Rays start this far (local units) from the surface, along the geometric normal towards the viewer. Float
/// coordinates of size 1 round to 6e-8; with Embree's robust mode 1e-5 keeps a surface from shadowing itself,
/// and moves contact shadows by a hundred-thousandth of the scene.
inline constexpr double kRayOffset = 1e-5;

/// What lies nearer to the light's plane than this (local units) hides nothing: whether a sheet in that plane
/// is in front of it is left to rounding. Rays end there, and edges are cut there.
inline constexpr double kLightOffset = 2e-6;
/// Where on its way to the light a ray ends that begins at this height in front of the light's plane (local
/// units).
inline float ray_end(float height) {
  return height > static_cast<float>(kLightOffset) ? 1.0f - static_cast<float>(kLightOffset) / height : 0.0f;
}

/// Embree's hierarchies over a scene's objects in one frame.
class RayScene {
 public:
  RayScene(const Scene& scene, const RayFrame& frame, detail::Threads threads);
  /// In the frame of the scene's first light, on threads of its own (0: all cores).
  RayScene(const Scene& scene, int threads);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

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
