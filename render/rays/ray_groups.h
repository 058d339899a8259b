// Which objects share a hierarchy of rays: those that one float frame suits.
//
// Float keeps 24 bits of a coordinate, counted from the extent of the frame. A box of size 1 beside a floor
// of size 1,000,000 keeps four of them. So objects are joined into groups of similar size that lie close
// together, each with a frame of its own. The connected parts of one mesh are told apart in the same way; a
// connected one stays whole.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace penumbra::detail {

/// Faces of one object.
struct RayPart {
  std::uint32_t object = 0;
  /// In the object's mesh, ascending. Empty: all of them.
  std::vector<std::uint32_t> faces;
};

/// Never empty.
struct RayPartGroup {
  std::vector<RayPart> parts;
  Bounds bounds;
};

/// All faces of the objects that cast, or of those that do not, in up to eight groups. Nearly all scenes have
/// one: so it is where the whole is at most 256 times the size of its smallest part. An object appears once
/// in a group. Cost O(parts); O(faces) where a mesh has several components.
std::vector<RayPartGroup> group_by_scale(const Scene& scene, bool casts);

}  // namespace penumbra::detail
