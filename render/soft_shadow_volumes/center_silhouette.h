// Method soft-shadow-volumes, step silhouettes: the edges that are silhouettes as seen from a point of the
// light.
//
// In: the light's band, a point of the unit disk. Out: the edges at which the number of layers between the
// light and what is behind the casters changes, as seen from that point, and by how much.
//
// Layers: a solid hides the light once, though a ray through it meets two faces; a sheet, such as a leaf,
// hides it by its one face. So a face of a solid counts as half a layer. What has few boundary edges for its
// size is a solid, with holes or without. Where the light's center is inside a solid, rays leave by one face:
// each then counts as a layer.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/rays/ray_scene.h"
#include "render/silhouette/collect/light_band.h"

namespace penumbra::detail {

/// Layers that one face of an object counts as: 1/2 or 1; one an object. Cost O(1) for meshes that are
/// closed, O(edges) for others. `center`: of the light; nothing is inside of a distant one.
std::vector<double> layers_of_faces(const Scene& scene, const RayScene& rays, const CircularLight& light);

/// The edges of the bands of solids and of sheets as one band.
struct LayeredBand {
  Band band;
  /// One an edge: the layers of a face beside it.
  std::vector<double> layers;
};
/// `layers`: one an object.
LayeredBand make_layered_band(const Scene& scene, const UnitLight& unit, const SceneEdges& edges,
                              const Bounds& asked_about, const std::vector<char>& cannot_occlude,
                              const std::vector<double>& layers);

struct CenterSilhouette {
  CenterSilhouette(const LayeredBand& from, const glm::dvec2& point);

  /// Its edges have no right faces: what receivers see of their faces decides nothing.
  Band band;
  /// One an edge a → b: layers on its left minus layers on its right, behind the casters.
  std::vector<double> steps;

  double step_of(const BandEdge& edge) const {
    return steps[static_cast<std::size_t>(&edge - band.edges.data())];
  }
};

}  // namespace penumbra::detail
