// Method view-samples, from faces to V: one tile of up to 64 receivers after the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/silhouette/collect/tile_receivers.h"
#include "render/view_samples/face_tree.h"
#include "render/view_samples/sample_masks.h"
#include "render/view_samples/view_samples.h"

namespace penumbra::detail {

/// What a call is asked, and its light.
struct MaskCall {
  const Scene& scene;
  const AreaLight& light;
  const Receivers& receivers;
  ViewSampleOptions options;
};

/// What one thread keeps between tiles, and what it has counted.
struct MaskWorkspace {
  MaskWorkspace(const AreaLight& light, const UnitLight& unit, int samples) : masks(light, unit, samples) {}

  std::vector<TileReceiver> tile;
  SampleMasks masks;
  ViewSampleCounts counts;
};

class MaskedTiles {
 public:
  /// Refers to its arguments.
  MaskedTiles(const MaskCall& call, const FaceTree& faces, const ReceiverSource& source,
              std::span<float> visibility)
      : call_(call), faces_(faces), source_(source), visibility_(visibility) {}

  /// Writes V of the receivers of a group.
  void answer(std::size_t group, MaskWorkspace& w) const;

 private:
  using List = std::vector<std::uint32_t>;

  Shaft shaft_of(std::span<const TileReceiver> part) const;
  void divide(std::span<TileReceiver> part, const List& list, MaskWorkspace& w) const;
  float visible_to(const TileReceiver& receiver, const List& list, MaskWorkspace& w) const;
  bool hides_nothing(const LitFace& face, const FaceCone& cone, std::uint32_t receiver) const;

  const MaskCall& call_;
  const FaceTree& faces_;
  const ReceiverSource& source_;
  const std::span<float> visibility_;
};

}  // namespace penumbra::detail
