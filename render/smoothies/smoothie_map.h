// Method smoothies, step fins: quads of one width along silhouettes, as the light's center sees them.
//
// At each silhouette edge stands a fin that faces the center. It is as wide everywhere in the map, and round
// at the edge's ends. Each texel keeps, of the fins over it, that whose edge is nearest in relation to the
// width, alpha from 0 to 1, and that edge's height.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/center_view/map_edges.h"

namespace penumbra::detail {

class SmoothieMap {
 public:
  /// `casters`: the map whose texels it has. `width`: in the map's coordinates. Cost O(texels near edges), on
  /// all threads of the arena.
  SmoothieMap(const ShadowMap& casters, const std::vector<MapEdge>& edges, double width,
              tbb::task_arena& threads);

  /// The fin at a texel; alpha 1 where there is none, and beside the map.
  struct Fin {
    float alpha, height;
  };
  Fin at(const glm::dvec2& place) const;
  TexturePicture picture() const;

 private:
  void draw(const MapEdge& edge, double width);
  static Fin decoded(std::uint64_t code);

  const ShadowMap& casters_;
  /// The bits of alpha, which are ordered as it is, above those of the height.
  std::unique_ptr<std::uint64_t[]> fins_;
};

}  // namespace penumbra::detail
