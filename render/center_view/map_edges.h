// What the light's center sees: silhouettes in the coordinates of its shadow map.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "render/center_view/shadow_map.h"
#include "render/center_view/volume_polygons.h"

namespace penumbra::detail {

struct MapEdge {
  glm::dvec2 a, b;
  /// Heights of its ends.
  double height_a, height_b;

  /// The nearest point to a place: how far, and its height.
  struct Nearest {
    double distance, height;
  };
  Nearest nearest(const glm::dvec2& place) const;
  double top() const { return height_a > height_b ? height_a : height_b; }
};

/// The sides' edges, as far as they lie in front of the light. Cost O(sides).
std::vector<MapEdge> map_edges(const VolumePolygons& polygons, const LightProjection& projection);

}  // namespace penumbra::detail
