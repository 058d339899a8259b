// Bake: which parts of which faces lie in which texels.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "penumbra/render/bake/texture_atlas.h"

namespace penumbra::detail {

/// A rectangle of texels.
struct TexelRange {
  int left = 0, top = 0, width = 0, height = 0;

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

/// The part of a face in one cell: a texel, or one of the squares that it is divided into.
struct TexelPiece {
  int x = 0, y = 0;  ///< the texel
  std::uint32_t object = 0, face = 0;
  double area = 0.0;   ///< texels
  glm::dvec2 at{0.0};  ///< the centroid of its area, in the texture
};

/// Refers to the atlas.
class TextureCoverage {
 public:
  /// Cost O(faces + texels).
  TextureCoverage(const TextureAtlas& atlas, int tile);

  std::size_t tiles() const { return faces_.size(); }
  TexelRange range_of(std::size_t tile) const;
  /// The share of the texel's area that faces cover; 0 outside of the texture.
  float at(int x, int y) const;
  bool is_touched(int x, int y) const { return at(x, y) > 0.0f; }
  bool is_full(int x, int y) const { return at(x, y) == 1.0f; }
  /// A bilinear lookup in the texel may need a texel that is not full.
  bool is_at_border(int x, int y) const;

  /// Calls `visit` for every part of a face in every cell of the tile whose texel `wanted` says yes to; each
  /// texel is divided into side² cells. Pieces come face by face, always in the same order.
  void for_each_piece(std::size_t tile, int side, const std::function<bool(int x, int y)>& wanted,
                      const std::function<void(const TexelPiece&)>& visit) const;

 private:
  struct FaceNumber {
    std::uint32_t object, face;
  };

  const TextureAtlas& atlas_;
  int tile_, columns_;
  std::vector<std::vector<FaceNumber>> faces_;  ///< of each tile, in order
  std::vector<float> coverage_;
};

/// Where a point of the texture lies in a face, each coordinate at least 0, together 1. The face must have an
/// area in the texture.
Vec3 barycentric_in(const FaceUv& uv, const glm::dvec2& at);

}  // namespace penumbra::detail
