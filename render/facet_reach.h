// How far each facet of a caster's shadow boundary really reaches.
//
// A supporting plane is a local property: the light that grazes an edge may be cut off before it gets there,
// or by another part of the scene soon after. One ray a facet and cone, from the point of the disk where the
// plane touches it, past the edge, tells both. What is out of sight is not drawn, and what is cut short ends
// there: less to rasterise, and no exit from an umbra that something else still darkens. (The 2004 paper has
// neither; its section 6.2 names the artefacts.)
#pragma once

#include <vector>

#include "render/ray_scene.h"
#include "volumes/supports.h"

namespace penumbra::detail {

/// Distances from the disk in units of the distance to the edge: 0 where the edge is hidden from its contact,
/// else > 1, infinite where nothing is hit behind the edge.
struct FacetReach {
  std::vector<float> facets;  ///< one per facet
  std::vector<float> cones;   ///< one per cone sector
};

/// Which facets and cone sectors of a caster some receiver may read: 0 or 1 each.
struct ReadEntries {
  std::vector<char> facets, cones;
};

/// Those that are not read count as hidden. Cost O((facets + cones) log faces), on all cores.
FacetReach find_reach(const TriangleMesh& mesh, const DiskLight& light, const Supports& supports,
                      const ReadEntries& read, const RayScene& rays);

}  // namespace penumbra::detail
