// What tests and benchmarks of visibility share: a scene's light, and the silhouette method in one call.
#pragma once

#include <variant>

#include "penumbra/render/receivers/surface_buffer.h"
#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/edge_hierarchies.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra::testing {

/// The scene's first light, which is made where there is none. It must be a disk.
inline DiskLight& light_of(Scene& scene) {
  if (scene.lights.empty()) scene.lights.emplace_back();
  return std::get<DiskLight>(scene.lights.front().shape);
}
inline const DiskLight& light_of(const Scene& scene) {
  return std::get<DiskLight>(scene.lights.at(0).shape);
}

/// Under the scene's first light, with hierarchies over edges made for this call.
inline SilhouetteResult see_silhouettes(const Scene& scene, const RayScene& rays,
                                        const SurfaceBuffer& surface, const SilhouetteOptions& options = {},
                                        const Progress& progress = {}) {
  detail::EdgeHierarchies hierarchies(scene);
  return silhouette_visibility(scene, rays, hierarchies, light_of(scene), surface.receivers(), options,
                               progress);
}

}  // namespace penumbra::testing
