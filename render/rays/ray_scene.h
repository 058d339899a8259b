// The scene as Embree sees it: rays for the surface buffer and occlusion rays for the reference.
//
// Float rays need a frame: everything is moved to the light's centre and scaled by a power of two to about
// unit size, so that float keeps its digits where shadows are decided (`RayFrame`).
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <span>

#include "penumbra/render/scene/scene.h"

namespace penumbra {

/// local = (world - origin) · scale; scale is a power of two, so that only the translation rounds.
struct RayFrame {
  Vec3 origin{0.0};
  double scale = 1.0;
  Vec3 to_local(const Vec3& world) const { return (world - origin) * scale; }
};

/// The frame of a scene: origin at the light, bounds of objects and light scaled into [-1, 1].
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

class RayScene {
 public:
  RayScene(const Scene& scene, int threads);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  const RayFrame& frame() const { return frame_; }
  /// The threads that the scene was made for. Work that traces rays belongs in here: arena().execute([&] { ... }).
  tbb::task_arena& arena() const;
  double build_ms() const { return build_ms_; }
  /// What the silhouette method's hierarchies over edges of casters took (scene_edges.h, merged_edges.h), which
  /// are made when they are first used; 0 before.
  double edge_hierarchy_ms() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  RayFrame frame_;
  double build_ms_ = 0.0;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
