// What facets, cone sectors and gap faces cover as seen from the light's center.
//
// In (u, v, w) = (x/z, y/z, 1/z) of the light's frame the plane that touches the disk of radius r at rim
// angle φ is w = (cos φ u + sin φ v + κ)/r, of slope 1/r for every edge, and the boundary at a vertex is a
// circular cone of that slope.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/d_buffer/entries/facet_reach.h"
#include "render/d_buffer/entries/receiver_grid.h"

namespace penumbra::detail {

/// A change from world to the light's frame: axes u, v, w of the light, origin its center, lengths times a
/// power of two.
struct LightSpace {
  LightSpace(const DiskLight& light, double scale_factor);
  Vec3 to_light(const Vec3& world) const;
  LightFrame axes;
  Vec3 center;
  double scale, radius;  ///< radius: of the disk, in this space
};

/// A point in (u, v, w).
struct Uvw {
  glm::dvec2 uv;
  double w;
};

struct FootprintOptions {
  double near_depth;   ///< edges are cut at this depth
  double far_weight;   ///< 1/z of the farthest receiver: boundaries end there
  double dilation;     ///< in (u, v): boundaries grow by this to all sides, to reach every texel they touch
  bool grows_with_uv;  ///< times 1 + |uv|, as the texels of a hemicube do
  double narrow;       ///< in (u, v): of what is no wider than this one ray tells the reach as well as three
};

/// Footprints of one caster's boundary. Refers to its arguments.
class EntryFootprints {
 public:
  EntryFootprints(const TriangleMesh& mesh, const LightSpace& space, const Supports& supports,
                  const FootprintOptions& options)
      : mesh_(mesh), space_(space), supports_(supports), options_(options) {}

  Vec3 local(VertexId v) const { return space_.to_light(mesh_.position(v)); }
  VertexId begin_of(const SupportFacet& f) const;
  VertexId end_of(const SupportFacet& f) const;

  /// The quadrilateral from the edge (corners 0 and 1, as directed) along its plane to where its reach ends
  /// (2 and 3, beyond 1 and 0), and 1/z of the edge's ends. None where the edge is nearer than the near
  /// depth.
  struct Facet {
    std::array<Uvw, 4> corners;
    double from_weight, to_weight;
  };
  /// `far_weight` is used where it is greater than the options'.
  std::optional<Facet> facet(std::uint32_t i, float reach, double far_weight) const;

  /// Where the cone's circle lies; it slopes down from the apex.
  struct Cone {
    Uvw apex;
    double radius;
  };
  std::optional<Cone> cone(const ConeSector& cone, float reach, double far_weight) const;

  /// The face, dilated. None for one that reaches the near depth: the facets have to do.
  std::optional<std::array<Uvw, 3>> gap(const GapFace& gap) const;

  double dilation(const glm::dvec2& uv) const;
  double disk_radius() const { return space_.radius; }
  double narrow() const { return options_.narrow; }

 private:
  bool cut(Vec3& a, Vec3& b) const;
  double extent(double w, float reach, double far_weight) const;
  void grow(std::array<Uvw, 3>& corners) const;

  const TriangleMesh& mesh_;
  const LightSpace& space_;
  const Supports& supports_;
  const FootprintOptions& options_;
};

template <std::size_t n>
UvBounds uv_bounds_of(const std::array<Uvw, n>& corners) {
  UvBounds out;
  for (const Uvw& c : corners) out.add(c.uv);
  return out;
}
inline UvBounds uv_bounds_of(const EntryFootprints::Cone& cone) {
  return {cone.apex.uv - cone.radius, cone.apex.uv + cone.radius};
}

/// How many rays it takes to find the reach of each facet (see facet_reach.h): 0 where no receiver would read
/// it, nor a gap face beside it, even if nothing cut it short. Cost O(facets + gaps), on all cores.
std::vector<std::uint8_t> count_facet_probes(const EntryFootprints& footprints, const Supports& supports,
                                             const std::vector<GapFace>& gaps, const ReceiverGrid& receivers);
/// The same for cone sectors.
std::vector<std::uint8_t> count_cone_probes(const EntryFootprints& footprints, const Supports& supports,
                                            const ReceiverGrid& receivers);

}  // namespace penumbra::detail
