// How far each facet of a caster's shadow boundary really reaches.
//
// A supporting plane is a local property: the light that grazes an edge may be cut off before it gets there,
// or by another part of the scene soon after. Rays from the point of the disk where the plane touches it,
// past the edge, tell both. What is out of sight is not drawn, and what is cut short ends there: less to
// rasterise, and no exit from an umbra that something else still darkens. (The 2004 paper has neither; its
// section 6.2 names the artefacts.)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// Distances from the disk in units of the distance to the edge: 0 where the edge is hidden from its contact,
/// else > 1, infinite where nothing is hit behind the edge.
struct FacetReach {
  std::vector<float> facets;  ///< one per facet
  std::vector<float> cones;   ///< one per cone sector
};

/// Fills `facets`, the greatest reach of up to three rays each; those without a ray count as hidden. Cost
/// O(rays · log faces), on all cores.
void find_facet_reach(const TriangleMesh& mesh, const DiskLight& light, const Supports& supports,
                      std::span<const std::uint8_t> probes, const RayScene& rays, FacetReach& out);
/// Fills `cones` in the same way.
void find_cone_reach(const TriangleMesh& mesh, const DiskLight& light, const Supports& supports,
                     std::span<const std::uint8_t> probes, const RayScene& rays, FacetReach& out);

}  // namespace penumbra::detail
