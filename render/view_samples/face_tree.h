// Method view-samples, step faces: which faces may hide some of the light from a few receivers.
//
// In: the casters, a frame of the light, receivers that lie close together. Out: the faces whose boxes reach
// into the shaft between those receivers and the light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/edges/unit_light.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

/// In the light's frame.
struct LitFace {
  FaceCorners corners;
  Bounds box;
  std::uint32_t object, face;
};

class FaceTree {
 public:
  /// `left_out`: one flag an object, or empty. Faces wholly behind the light's plane are left out. Cost
  /// O(faces log faces), on the calling arena's threads.
  FaceTree(const Scene& scene, const UnitLight& unit, const std::vector<char>& left_out);

  /// Into `out` the numbers of the faces in a shaft; it is replaced.
  void collect(const Shaft& shaft, std::vector<std::uint32_t>& out) const;
  const LitFace& face(std::uint32_t number) const { return faces_[number]; }
  std::size_t size() const { return faces_.size(); }
  /// The largest coordinate.
  double extent() const { return extent_; }

 private:
  void build();

  static constexpr std::size_t kLeaf = 4;  // speed: faces a leaf

  std::vector<LitFace> faces_;
  /// From the leaves up, two children a node.
  std::vector<std::vector<Bounds>> levels_;
  double extent_ = 1.0;
};

}  // namespace penumbra::detail
