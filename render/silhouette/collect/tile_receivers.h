// Silhouette method, step collect: the receivers of a group in the light's frame, and those that
// need no look at edges.
//
// In: receivers. Out: their points in the light's frame, with the chord that each one's horizon cuts off the
// disk.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/receivers/receiver_groups.h"
#include "render/silhouette/collect/shaft.h"
#include "render/silhouette/edges/unit_light.h"

namespace penumbra::detail {

/// Where it is written what is known of receivers that see nothing of the light, one entry a receiver.
struct DecidedReceivers {
  /// V: 0.
  std::span<float> visibility;
  /// 2 behind the light, else as it is; empty where nobody asks.
  std::span<std::int8_t> region{};
};

/// Refers to its arguments.
class ReceiverSource {
 public:
  /// What is decided here is written to `out`, each receiver by itself. `horizon`: whether tangent planes
  /// hide what lies below them.
  ReceiverSource(const Receivers& receivers, const ReceiverGroups& groups, const UnitLight& light,
                 bool horizon, const DecidedReceivers& out);

  /// Into `receivers` those of a group that see some of the light's front above their horizon; it is
  /// replaced. Returns how many receivers are behind the light, hence in umbra.
  std::size_t collect(std::size_t group, std::vector<TileReceiver>& receivers) const;
  /// Writes that all receivers of a group are wholly lit.
  void light_up(std::size_t group) const;

 private:
  /// What one receiver is.
  enum class Kind : std::uint8_t { kReceiver, kAbsent, kBehindLight, kBelowHorizon };
  Kind add(std::uint32_t index, std::vector<TileReceiver>& receivers) const;

  const Receivers& receivers_;
  const ReceiverGroups& groups_;
  const UnitLight& light_;
  const bool horizon_;
  DecidedReceivers out_;
};

/// Sorts receivers into two halves along the longest side of their box; returns where the second begins.
std::size_t halve(std::span<TileReceiver> receivers);

}  // namespace penumbra::detail
