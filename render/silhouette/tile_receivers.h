// Silhouette method, before step 2: the receivers of a tile, and the pixels that need no looking.
//
// In: the surface buffer. Out: its points in the light's frame, moved off their surfaces as the origins of
// rays are, with the chord that each one's horizon cuts off the disk.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra::detail {

/// Refers to its arguments.
class ReceiverSource {
 public:
  /// What is decided here is written to `out`, each pixel by itself.
  ReceiverSource(const Scene& scene, const RayFrame& frame, const SurfaceBuffer& surface,
                 const UnitLight& light, SilhouetteResult& out);

  /// Into `receivers` those of a tile that see some of the light's front above their horizon, into
  /// `undecided` also the pixels that only the offset moves behind the light's plane; both in the order of
  /// pixels, the first replaced and the second appended to. Returns how many pixels are behind the light,
  /// hence in umbra.
  std::size_t collect(int column, int row, std::vector<TileReceiver>& receivers,
                      std::vector<std::uint32_t>& undecided) const;

 private:
  /// What one pixel is.
  enum class Kind : std::uint8_t { kReceiver, kNoSurface, kBehindLight, kBelowHorizon, kUndecided };
  Kind add(std::size_t pixel, std::vector<TileReceiver>& receivers) const;

  const Scene& scene_;
  const SurfaceBuffer& surface_;
  const UnitLight& light_;
  const double offset_;  ///< scene units
  SilhouetteResult& out_;
};

/// Sorts receivers into two halves along the longest side of their box; returns where the second begins.
std::size_t halve(std::span<TileReceiver> receivers);

}  // namespace penumbra::detail
