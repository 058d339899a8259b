// Method layered-attenuation, step map: the surfaces that points of the light see, and from how many of them
// each is seen.
//
// In: the scene, the light in the coordinates of its center, points of the light. Out: for each texel of the
// center's view a list of layers: a height, and the number of points that see a surface there.
//
// In the map's coordinates a point d of the light sees the scene sheared: a surface at (q, h) lies at q - s d
// h in its view, s the light's spread. So first surfaces of that view are taken back to the center's by
// adding s d h.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/center_view/shadow_map.h"

namespace penumbra::detail {

struct AttenuationOptions {
  /// Texels a side.
  int size = 512;
  /// Points of the light.
  int views = 64;
  /// Heights that differ by less are one layer; texels.
  double tolerance = 2.0;
};

class AttenuationMap {
 public:
  /// `lowest`, `top`: heights between which surfaces are looked for. Cost O(views · (faces + texels)).
  AttenuationMap(const Scene& scene, const LightProjection& projection, const MapWindow& window,
                 double lowest, double top, bool disk, const AttenuationOptions& options,
                 tbb::task_arena& threads);

  /// The share of the points that see a surface at a height, within the tolerance times `slope` + 1; none
  /// where no point does, or beside the map.
  std::optional<double> share(const glm::dvec2& place, double height, double slope) const;
  std::size_t layers() const { return layers_; }
  TexturePicture picture() const;

 private:
  struct Layer {
    float height;
    std::uint16_t seen, last;
  };
  void add_view(const ShadowMap& view, const glm::dvec2& shear, std::uint16_t number);
  void add(std::size_t texel, float height, std::uint16_t number);

  MapWindow window_;
  int size_, views_ = 0;
  glm::dvec2 per_texel_;
  double tolerance_;
  std::size_t layers_ = 0;
  std::vector<std::vector<Layer>> texels_;
};

}  // namespace penumbra::detail
