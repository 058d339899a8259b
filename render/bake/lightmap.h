// Bake: a lightmap, the light of a scene's surfaces as a texture.
//
//   make_atlas      objects → where each face lies in the texture         (texture_atlas.h)
//   LightmapBaker   texture → tiles → values of each, in any order, on any machine
//   finish          values of all tiles → Lightmap
//
// A texel that faces touch, by however little, has the mean over the parts of faces in it, weighted by their
// areas in the texture: one receiver each, at the centroid of the part. Receivers lie on the faces; nothing
// is moved off them.
//
// A bilinear lookup near the border of a chart needs texels that the chart covers in part or not at all.
// Their values are found so that lookups are right: by least squares over 16 further receivers in each texel
// along the border. Lookups on both sides of a seam then agree, since both give what is there, and no texel
// of another chart counts as long as two empty texels lie between charts. A part of the idea is in S.
// Iwanicki, "Lighting technology of The Last of Us" (2013), who makes both sides agree with each other; here
// each agrees with receivers.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "penumbra/render/bake/bake_receivers.h"
#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra {

struct LightmapOptions {
  /// Of a tile, texels.
  int tile = 64;
  /// Each texel is divided into samples² squares, each with receivers of its own. 1: one receiver for each
  /// face in the texel.
  int samples = 1;
  /// Texels that charts do not cover get values near borders as for lookups. Else they have the mean of
  /// texels beside them, and texels that are covered in part that of their covered part.
  bool fit_borders = true;
  /// So many texels around charts get values, for filters wider than bilinear ones.
  int dilation = 2;
};

struct Lightmap {
  int width = 0, height = 0;
  /// width · height each, row 0 at the top. One a light, or red, green and blue. 0 where no chart is near.
  std::vector<std::vector<float>> channels{};
  /// The share of each texel that faces cover, 0 to 1.
  std::vector<float> coverage{};

  /// The bilinear lookup at a point of the texture, in texels; coordinates beyond the centers of the outer
  /// texels are clamped.
  double look_up(std::size_t channel, const glm::dvec2& at) const;
};

/// Refers to the source and the atlas. One call of `bake` at a time.
class LightmapBaker {
 public:
  /// Throws UsageError for options outside of their domain. Cost O(faces + texels).
  LightmapBaker(const BakeSource& source, const TextureAtlas& atlas, const LightmapOptions& options = {});
  ~LightmapBaker();

  std::size_t tiles() const;
  /// How many texels of the tile faces touch: what it costs.
  std::size_t touched(std::size_t tile) const;
  /// Values of a tile, for `finish`. The same wherever and whenever it is called. Throws as `visibility`
  /// does.
  std::vector<float> bake(std::size_t tile, const Progress& progress = {}) const;
  /// How many values that are.
  std::size_t values(std::size_t tile) const;
  /// `values_of(tile)` gives what `bake` gave; each is called for once, in order. Throws UsageError for
  /// values of another number.
  Lightmap finish(const std::function<std::vector<float>(std::size_t tile)>& values_of) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// All tiles, one after the other.
Lightmap bake_lightmap(const BakeSource& source, const TextureAtlas& atlas,
                       const LightmapOptions& options = {}, const Progress& progress = {});

/// Where a point on a face lies in the texture.
glm::dvec2 place_in_atlas(const TextureAtlas& atlas, const TriangleMesh& mesh, std::size_t object,
                          std::uint32_t face, const Vec3& point);

}  // namespace penumbra
