// Method penumbra-maps, step penumbra: how much light the first surface gets, outside of hard shadows.
//
// Over a point at the height h_e a light of radius r (of spread, in the map's coordinates) makes a cone: at
// the height h it is r (h_e - h) wide. Cones over an edge's points, and the sheets between them, together
// hold what is that near to the edge. With ρ the distance of a texel from the edge, its first surface at the
// height h gets the share ρ / (r (h_e - h)). Of several edges the least counts.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/center_view/map_edges.h"

namespace penumbra::detail {

class PenumbraMap {
 public:
  /// `surfaces`: the map of first surfaces, whose texels it has. `lowest`: no surface is lower. Cost O(texels
  /// near edges), on all threads of the arena.
  PenumbraMap(const ShadowMap& surfaces, const std::vector<MapEdge>& edges, double radius, double lowest,
              tbb::task_arena& threads);

  /// Between those of the four texels around a place that have a surface; 1 beside the map.
  float share(const glm::dvec2& place) const;
  TexturePicture picture() const;

 private:
  void draw(const MapEdge& edge, double radius, double lowest);
  struct Weighed {
    float share, weight;
  };
  Weighed at(int x, int y, float weight) const;

  const ShadowMap& surfaces_;
  /// Floats of 0 to 1: their bits are ordered as they are.
  std::unique_ptr<std::uint32_t[]> shares_;
};

}  // namespace penumbra::detail
