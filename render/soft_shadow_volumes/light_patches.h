// Method soft-shadow-volumes: the light in patches, each with a point from which its silhouettes are seen.
//
// The light's square is cut into splits × splits cells. A disk's cells end at its rim. Patches are convex,
// and together they are the light.
#pragma once

#include <vector>

#include "render/light/area_light.h"
#include "render/silhouette/edges/unit_light.h"
#include "render/soft_shadow_volumes/polygon_area.h"

namespace penumbra::detail {

/// In the plane of the unit disk.
struct LightPatch {
  /// Of a disk the cell: what lies beyond the rim does not count.
  Polygon outline;
  /// A polygon within the patch.
  Polygon inner;
  /// The middle of the patch.
  glm::dvec2 center{0.0};
};

struct LightPatches {
  /// `unit`: the frame of a disk that holds the light.
  LightPatches(const AreaLight& light, const UnitLight& unit, int splits);

  /// Of the part of a patch's outline that is on the light.
  double area(const Polygon& outline) const { return disk ? area_in_disk(outline) : area_of(outline); }

  bool disk;
  /// One patch, which is all of a disk.
  bool whole_disk;
  std::vector<LightPatch> patches;
  /// Of all of them.
  double total = 0.0;
};

}  // namespace penumbra::detail
