// D-buffer step 4: what facets, cone sectors and gap faces cover, seen from the light's center.
//
// In: a caster's supports in world space. Out: polygons in (u, v, w) = (x/z, y/z, 1/z) of the light's frame,
// dilated so that every texel they touch is drawn. There the plane that touches the disk of radius r at rim
// angle φ is w = (cos φ u + sin φ v + κ)/r: it has the slope 1/r for every edge. The boundary at a vertex is
// a circular cone of that slope, with its apex at the vertex.
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

/// World → the light's frame: axes u, v, w of the light, origin its center, lengths times a power of two. All
/// that the D-buffer draws is in this frame.
struct LightSpace {
  LightSpace(const DiskLight& light, double scale_factor);
  Vec3 to_light(const Vec3& world) const;
  LightFrame axes;
  Vec3 center;
  double scale;
  /// Of the disk, in the light's frame.
  double radius;
};

/// A point in (u, v, w).
struct Uvw {
  glm::dvec2 uv;
  double w;
};

struct FootprintOptions {
  /// Edges are cut at this z.
  double near_depth;
  /// 1/z of the farthest receiver: boundaries end there.
  double far_weight;
  /// In (u, v): polygons grow by this to all sides, so that every texel they touch is drawn.
  double dilation;
  /// The dilation is multiplied by 1 + |uv|, as the texels of a hemicube grow.
  bool grows_with_uv;
  /// In (u, v): of what is no wider than this one ray tells the reach as well as three.
  double narrow;
};

/// Footprints of one caster's boundary. Refers to its arguments.
class EntryFootprints {
 public:
  EntryFootprints(const TriangleMesh& mesh, const LightSpace& space, const Supports& supports,
                  const FootprintOptions& options)
      : mesh_(mesh), space_(space), supports_(supports), options_(options) {}

  /// In the light's frame.
  Vec3 in_light_frame(VertexId v) const { return space_.to_light(mesh_.position(v)); }
  VertexId begin_of(const SupportFacet& f) const;
  VertexId end_of(const SupportFacet& f) const;

  /// The quadrilateral from the edge (corners 0 and 1, as directed) along its plane to where its reach ends
  /// (2 and 3, beyond 1 and 0), and 1/z of the edge's ends. None where the edge is nearer than the near
  /// depth.
  struct Facet {
    std::array<Uvw, 4> corners;
    double from_weight, to_weight;
  };
  /// Of facet i of the supports. `reach`: as from facet_reach.h. The facet ends at 1/z = `far_weight` if that
  /// is greater than the options'.
  std::optional<Facet> facet(std::uint32_t i, float reach, double far_weight) const;

  /// The circle that the whole cone covers; 1/z falls from the apex to all sides.
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

/// How many rays it takes to find the reach of each facet (see facet_reach.h): 0 to 3. 0 where no receiver
/// would read the facet or a gap face beside it, even if nothing cut it short. Cost O(facets + gaps), on all
/// cores.
std::vector<std::uint8_t> count_facet_probes(const EntryFootprints& footprints, const Supports& supports,
                                             const std::vector<GapFace>& gaps, const ReceiverGrid& receivers);
/// The same for cone sectors.
std::vector<std::uint8_t> count_cone_probes(const EntryFootprints& footprints, const Supports& supports,
                                            const ReceiverGrid& receivers);

}  // namespace penumbra::detail
