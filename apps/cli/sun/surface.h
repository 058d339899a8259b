// The surface of what people name: an object of the scene, or all tiles of a heightfield as one.
#pragma once

#include <string>
#include <vector>

#include "penumbra/render/scene/scene.h"

namespace penumbra::apps {

struct Surface {
  std::vector<Vec3> positions{};
  std::vector<IndexedTriangle> triangles{};
  /// One a triangle: the object of the scene, and its face.
  std::vector<std::int32_t> objects{};
  std::vector<std::uint32_t> faces{};

  /// Of any length: twice the area.
  Vec3 cross(std::size_t triangle) const;
};

/// Numbers of the objects that are meant: one, or the tiles that follow each other of the first heightfield
/// of that name. `name` as for surface_of; throws like it.
std::vector<std::size_t> objects_named(const Scene& scene, const std::string& name);

/// `name`: of a mesh or of a heightfield as the scene file has it, or the number of an object, a tile say.
/// Vertices where tiles meet are one. Throws UsageError that lists what there is.
Surface surface_of(const Scene& scene, const std::string& name);

}  // namespace penumbra::apps
