// Bake: where faces lie in the one texture of a scene.
//
// Coordinates are in texels: x to the right, y down, (0, 0) at the top left corner of the texture. Texel (i,
// j) is the square from (i, j) to (i + 1, j + 1); its center is at + 0.5. A texture coordinate of glTF is (x
// / width, y / height), of OBJ (x / width, 1 - y / height).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace penumbra {

/// The corners of a face in the texture.
using FaceUv = std::array<glm::dvec2, 3>;

struct TextureAtlas {
  int width = 0, height = 0;
  /// One list an object of the scene, one entry a face; empty for an object that is not in the atlas.
  std::vector<std::vector<FaceUv>> uv{};
  /// How many charts were packed.
  std::size_t charts = 0;
  /// How long the side of a texel is on a flat chart, scene units: rectangles of whole texels stretch charts
  /// by less than one texel. 0 where the texture coordinates were given.
  double texel = 0.0;

  bool has(std::size_t object) const { return !uv[object].empty(); }
};

struct AtlasOptions {
  /// Texels: the sides of the square into which all charts go, as large as they fit.
  int size = 512;
  /// Or the side of a texel, scene units; the texture is then as large as it has to be. 0: `size` counts.
  double texel = 0.0;
  /// Empty texels between two charts, and from the edge of the texture half of that. Two keep bilinear
  /// lookups apart.
  int padding = 2;
  /// Neighboring faces are one chart while their normals are within so many degrees of the first face's.
  double chart_degrees = 30.0;
  /// Numbers of the objects to be baked; empty: all.
  std::vector<std::size_t> objects{};
};

/// Charts of neighboring faces, each projected to a plane, put in rows by height. Faces without area get no
/// texel. Throws UsageError where the charts do not fit: each takes one texel and its padding at least. Cost
/// O(faces · log faces).
TextureAtlas make_atlas(const std::vector<SceneObject>& objects, const AtlasOptions& options);

/// The objects' own texture coordinates (SceneObject::corner_uv) in a texture of options.size² texels; of the
/// options `objects` counts besides. Throws UsageError that names the object and the face where a corner has
/// no coordinates or lies outside of 0 to 1, and where two faces have more than 1/64 of a texel in common: it
/// would get two values. Expected cost O(faces · log faces).
TextureAtlas given_atlas(const std::vector<SceneObject>& objects, const AtlasOptions& options);

}  // namespace penumbra
