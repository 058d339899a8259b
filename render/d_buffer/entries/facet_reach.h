// D-buffer step 4: how far each facet of a shadow boundary really reaches.
//
// In: supports, rays. Out: a distance a facet and a cone sector. That a plane touches disk and caster is a
// local property: the light that grazes an edge may be blocked before it gets there, or by another part of
// the scene soon after. Rays from the point where the plane touches the disk, past the edge, tell both. A
// facet whose edge is hidden is not drawn, and one that is cut short ends there: there is less to draw, and
// no exit from an umbra that something else still darkens. The 2004 paper has neither; its section 6.2 names
// the artifacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// Distances from the disk, in units of the distance to the edge: 0 where the edge is hidden from the point
/// that the plane touches the disk in; else above 1, infinite where nothing is hit behind the edge.
struct FacetReach {
  /// One a facet, one a cone sector.
  std::vector<float> facets, cones;
};

/// Fills `facets` of `out`: the greatest reach of up to three rays each, as many as `probes` says. A facet
/// without a ray counts as hidden. Cost O(rays · log faces), on all cores.
void find_facet_reach(const TriangleMesh& mesh, const DiskLight& light, const Supports& supports,
                      std::span<const std::uint8_t> probes, const RayScene& rays, FacetReach& out);
/// Fills `cones` in the same way.
void find_cone_reach(const TriangleMesh& mesh, const DiskLight& light, const Supports& supports,
                     std::span<const std::uint8_t> probes, const RayScene& rays, FacetReach& out);

}  // namespace penumbra::detail
