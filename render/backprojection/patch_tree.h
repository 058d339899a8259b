// Method backprojection, step patches: texels of a shadow map as small rectangles parallel to the light, and
// which of them lie between a receiver and the light.
//
// In: a shadow map. Out: for a receiver at (q, h), the texels that are higher and in front of its light, by a
// pyramid of greatest and least heights. Texels that are nearly one surface, and together seen smaller than a
// few samples, are one patch. A texel from q0 to q1 at the height H hides the part from (q0 - q) / (s (H -
// h)) to (q1 - q) / (s (H - h)) of the light, s its spread.
//
// Where texels next to each other have different heights, their parts of the light leave a gap, though they
// may be one surface. Gap filling stretches a texel to the borders of its left and lower neighbors, where
// those are higher than the receiver, too.
#pragma once

#include <optional>
#include <vector>

#include "render/backprojection/light_masks.h"
#include "render/center_view/map_options.h"
#include "render/center_view/map_receivers.h"

namespace penumbra::detail {

struct PatchOptions {
  MapBias bias;
  bool fill_gaps = true;
};

class PatchTree {
 public:
  /// Refers to its arguments. Cost O(texels).
  PatchTree(const ShadowMap& map, const glm::dvec2& spread, const LightMasks& masks,
            const PatchOptions& options);

  /// Adds the samples that the map's patches hide from a receiver; returns how many patches it looked at.
  /// Stops where none is left.
  std::size_t hide(const MapReceiver& receiver, std::span<MaskWord> mask) const;

 private:
  struct Level {
    int size;
    std::vector<float> highest, lowest;
    std::size_t place(int x, int y) const {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
    }
  };
  struct Node {
    int level, x, y;
  };
  bool reaches_light(const MapReceiver& receiver, const Node& node, float highest) const;
  std::optional<LightRectangle> as_one_patch(const MapReceiver& receiver, const Node& node) const;
  bool is_higher(const MapReceiver& receiver, int x, int y, double height) const;
  LightRectangle part_of_light(const MapReceiver& receiver, int x, int y) const;

  const ShadowMap& map_;
  const glm::dvec2 spread_;
  const LightMasks& masks_;
  const PatchOptions options_;
  /// From 2×2 texels up.
  std::vector<Level> levels_;
};

}  // namespace penumbra::detail
