// D-buffer step 4: how far each facet of a shadow boundary really reaches.
//
// In: supports, rays. Out: a height a facet and a cone sector. That a plane touches disk and caster is a
// local property: the light that grazes an edge may be blocked before it gets there, or by another part of
// the scene soon after. Two rays from the edge tell: one to the point where the plane touches the disk, one
// on. A facet whose edge is hidden is not drawn, and one that is cut short ends there: there is less to draw,
// and no exit from an umbra that something else still darkens. The 2004 paper has neither; its section 6.2
// names the artifacts.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/d_buffer/view/light_space.h"
#include "render/rays/ray_scene.h"

namespace penumbra::detail {

/// Heights h of light space, of the surface that is hit behind the edge: -infinity where none is, kHidden
/// where the edge is hidden from the point that the plane touches the disk in.
struct FacetReach {
  static constexpr double kHidden = std::numeric_limits<double>::infinity();
  /// One a facet, one a cone sector.
  std::vector<double> facets, cones;
};
inline bool is_hidden(double end) {
  return end == FacetReach::kHidden;
}

/// Where rays are from and against what.
struct ProbeSource {
  /// Of the mesh, as in Scene::objects.
  std::int32_t object;
  const CircularLight& light;
  const LightSpace& space;
  const RayScene& rays;
};

/// Fills `facets` of `out`: the lowest end at up to three places each, as many as `probes` says. A facet
/// without one counts as hidden. Cost O(rays · log faces), on all cores.
void find_facet_reach(const TriangleMesh& mesh, const Supports& supports,
                      std::span<const std::uint8_t> probes, const ProbeSource& source, FacetReach& out);
/// Fills `cones` in the same way.
void find_cone_reach(const TriangleMesh& mesh, const Supports& supports, std::span<const std::uint8_t> probes,
                     const ProbeSource& source, FacetReach& out);

}  // namespace penumbra::detail
