// Silhouette method, step band: what casts under a light, in the light's frame.
//
// In: a scene, a light, the scene's edges. Out: the casters' boxes and the extent of the scene.
#pragma once

#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/silhouette/edges/scene_edges.h"
#include "render/silhouette/edges/unit_light.h"

namespace penumbra::detail {

/// Lengths are in light radii. Refers to its arguments.
struct LitScene {
  /// `edges` are the scene's. `asked_about`: bounds of casters and receivers.
  /// `cannot_occlude`: a flag an object, or none at all; casters whose flag is set are left out. Cost
  /// O(vertices), a hundredth of them where neighbors in a mesh's arrays are neighbors in space.
  LitScene(const Scene& scene, const UnitLight& light, const SceneEdges& edges, const Bounds& asked_about,
           std::span<const char> cannot_occlude = {});

  const Scene& scene;
  const UnitLight& light;
  std::span<const char> cannot_occlude;
  /// One an object; empty for objects that do not cast.
  std::vector<Bounds> boxes;
  /// The largest absolute coordinate of what is asked about; at least 1.
  double extent = 1.0;
  /// What lies nearer to the light's plane is in it as far as double can tell, and hides nothing.
  double depth;
  /// All casters lie in front of the light's plane.
  bool all_in_front = true;

  bool casts(std::size_t object) const { return !boxes[object].empty(); }
};

}  // namespace penumbra::detail
