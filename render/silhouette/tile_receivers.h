// Silhouette method, before edges are collected: the receivers of a group in the light's frame, and those that
// need no look at edges.
//
// In: receivers. Out: their points in the light's frame, moved off their surfaces as the starts of rays are,
// with the chord that each one's horizon cuts off the disk.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/receivers/receiver_groups.h"
#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/silhouette_visibility.h"

namespace penumbra::detail {

/// Refers to its arguments.
class ReceiverSource {
 public:
  /// What is decided here is written to `out`, each receiver by itself. `horizon`: whether tangent planes hide
  /// what lies below them.
  ReceiverSource(const Receivers& receivers, const ReceiverGroups& groups, const RayFrame& frame,
                 const UnitLight& light, bool horizon, SilhouetteResult& out);

  /// Into `receivers` those of a group that see some of the light's front above their horizon, into
  /// `undecided` also those that only the offset moves behind the light's plane; the first is replaced, the
  /// second appended to. Returns how many receivers are behind the light, hence in umbra.
  std::size_t collect(std::size_t group, std::vector<TileReceiver>& receivers,
                      std::vector<std::uint32_t>& undecided) const;

 private:
  /// What one receiver is.
  enum class Kind : std::uint8_t { kReceiver, kAbsent, kBehindLight, kBelowHorizon, kUndecided };
  Kind add(std::uint32_t index, std::vector<TileReceiver>& receivers) const;

  const Receivers& receivers_;
  const ReceiverGroups& groups_;
  const UnitLight& light_;
  const double offset_;  ///< scene units; 0 for receivers without normals
  const bool horizon_;
  SilhouetteResult& out_;
};

/// Sorts receivers into two halves along the longest side of their box; returns where the second begins.
std::size_t halve(std::span<TileReceiver> receivers);

}  // namespace penumbra::detail
