// Silhouette method, before edges are collected: receivers by their distance from what casts.
//
// In: groups of receivers, and the box of the casters. Out: shells of groups around the casters. Each shell is served in a
// frame of its own (edges/unit_light.h), so that a floor that reaches far costs receivers near the casters no digits, and
// floats dismiss as many edges for them as they would without it.
#pragma once

#include <cstdint>
#include <vector>

#include "render/receivers/receiver_box.h"

namespace penumbra::detail {

struct ReceiverShell {
  /// Ascending.
  std::vector<std::uint32_t> groups;
  /// The box of their receivers and of the casters, world.
  Bounds asked_about;
};

/// The innermost first; shells without receivers are left out, and so are groups without. Without casters there is one
/// shell. Cost O(groups).
std::vector<ReceiverShell> receiver_shells(const BoxedGroups& groups, const Bounds& casters);

}  // namespace penumbra::detail
