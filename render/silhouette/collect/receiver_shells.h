// Silhouette method, step collect: receivers by their distance from what casts.
//
// In: groups of receivers, and the box of the casters. Out: shells of groups around the casters. Each shell
// is served in a frame of its own (edges/unit_light.h), so that a floor that reaches far costs receivers near
// the casters no digits, and floats dismiss as many edges for them as they would without it.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/render/scene/scene.h"
#include "render/receivers/receiver_box.h"

namespace penumbra::detail {

struct ReceiverShell {
  /// Ascending.
  std::vector<std::uint32_t> groups;
  /// The box of their receivers and of the casters, world.
  Bounds asked_about;
};

/// The innermost first; shells without receivers are left out, and so are groups without. Without casters
/// there is one shell. Cost O(groups).
std::vector<ReceiverShell> receiver_shells(const BoxedGroups& groups, const Bounds& casters);

/// The receivers of a call, and the casters that may hide something from them. Refers to the groups.
struct ShelledReceivers {
  /// Cost as of what it is made of, on the calling arena's threads.
  ShelledReceivers(const Scene& scene, const CircularLight& light, const Receivers& receivers,
                   const BoxedGroups& groups);

  const BoxedGroups& boxed;
  const ReceiverGroups& groups;
  /// One flag an object (find_casters_that_cannot_occlude).
  std::vector<char> cannot_occlude;
  std::vector<ReceiverShell> shells;

  /// Calls `serve(shell, progress)` for each shell.
  template <class Serve>
  void for_each(const Progress& progress, const Serve& serve) const {
    double done = 0.0;
    for (const ReceiverShell& shell : shells) {
      const double part = static_cast<double>(shell.groups.size()) / static_cast<double>(groups.count());
      serve(shell, part_of(progress, done, done + part));
      done += part;
    }
  }
};

}  // namespace penumbra::detail
