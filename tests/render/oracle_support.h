// A scene as tests/oracle takes it.
#pragma once

#include <vector>

#include "penumbra/render/scene/scene.h"
#include "tests/oracle/oracle.h"

namespace penumbra::testing {

/// The vectors of a rectangle are its own; that across is normal x tangent.
inline oracle::Light oracle_light(const LightShape& shape) {
  if (const auto* disk = std::get_if<DiskLight>(&shape)) return *disk;
  if (const auto* distant = std::get_if<DistantLight>(&shape)) return *distant;
  const auto& r = std::get<RectangleLight>(shape);
  const Vec3 n = r.normal, t = r.tangent;
  const Vec3 across(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x);
  return oracle::Rectangle{r.center, r.half_extents.x * t, r.half_extents.y * across};
}

/// The meshes of the objects that cast shadows, in their order.
inline std::vector<TriangleMesh> casting_meshes(const Scene& scene) {
  std::vector<TriangleMesh> meshes;
  for (const SceneObject& object : scene.objects)
    if (object.casts) meshes.push_back(object.mesh);
  return meshes;
}

}  // namespace penumbra::testing
