// What the light's center sees, for several methods: silhouettes, and the surfaces of shadow volumes behind
// them.
//
// In: casters, the light's center. Out: caps, the faces that cast, turned towards the center, and sides: the
// part of the plane through the center and an edge that lies beyond the edge. A point is in as many volumes
// as there are such faces between it and the center.
//
// Of a closed mesh the faces that look at the center cast: the others lie behind those. A side then stands at
// each silhouette edge. Of an open mesh, and of one around the center, all faces do, each turned towards the
// center: edges between two of them whose sides cancel have none.
#pragma once

#include <cstdint>
#include <vector>

#include "penumbra/render/scene/scene.h"
#include "render/light/area_light.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

struct VolumeCap {
  /// Counter-clockwise as seen from the center.
  FaceCorners corners;
  std::uint32_t object, face;
};

/// Seen from the center, the volumes lie on the left of a → b.
struct VolumeSide {
  Vec3 a, b;
  /// How many volumes it bounds, 1 or more.
  int volumes;
};

struct VolumePolygons {
  std::vector<VolumeCap> caps;
  std::vector<VolumeSide> sides;
  /// Objects of which there are any.
  std::size_t casters = 0;
};

/// `left_out`: one flag an object, or empty. Which way a face looks is decided exactly. Cost O(faces).
VolumePolygons volume_polygons(const Scene& scene, const LightShape& light,
                               const std::vector<char>& left_out);

}  // namespace penumbra::detail
