// D-buffer step 4: what facets, cone sectors and gap faces cover, seen from the light's center.
//
// In: a caster's supports in world space. Out: polygons in (u, v, h) of light space
// (render/d_buffer/view/light_space.h), dilated so that every texel they touch is drawn. There the plane that
// touches the disk at rim angle φ is h = cos φ u + sin φ v + κ: it has the slope 1 for every edge. The
// boundary at a vertex is a circular cone of that slope, with its apex at the vertex.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "penumbra/volumes/supports.h"
#include "render/d_buffer/entries/facet_reach.h"
#include "render/d_buffer/entries/receiver_grid.h"
#include "render/d_buffer/view/view.h"

namespace penumbra::detail {

/// Footprints of one caster's boundary. Refers to its arguments.
class EntryFootprints {
 public:
  EntryFootprints(const TriangleMesh& mesh, const LightSpace& space, const Supports& supports,
                  const FootprintOptions& options)
      : mesh_(mesh), space_(space), supports_(supports), options_(options) {}

  VertexId begin_of(const SupportFacet& f) const;
  VertexId end_of(const SupportFacet& f) const;

  /// The part of the way from one vertex to another that receivers in the window may see before the disk, and
  /// that is in front of the light. Float keeps the digits of its ends, which it would not of those of a long
  /// edge.
  struct Segment {
    Uvh from, to;
    /// The ends are the vertices, not cut off.
    bool has_from, has_to;
  };
  std::optional<Segment> segment(VertexId from, VertexId to) const;

  /// The quadrilateral from the edge (corners 0 and 1, as directed) along its plane to where its reach ends
  /// (2 and 3, beyond 1 and 0), and h of the edge's ends. None where nothing is left of the edge's segment.
  struct Facet {
    std::array<Uvh, 4> corners;
    double from_height, to_height;
  };
  /// Of facet i of the supports. `end`: as from facet_reach.h. The facet ends at h = `far_height` if that is
  /// greater than the options'.
  std::optional<Facet> facet(std::uint32_t i, double end, double far_height) const;

  /// The circle that the whole cone covers; h falls from the apex to all sides.
  struct Cone {
    Uvh apex;
    double radius;
  };
  std::optional<Cone> cone(const ConeSector& cone, double end, double far_height) const;

  /// The face, dilated. None for one that is not wholly in front of the light: the facets have to do.
  std::optional<std::array<Uvh, 3>> gap(const GapFace& gap) const;

  /// What of a triangle is about the window, as triangles.
  std::vector<Uvh> about_window(const std::array<Uvh, 3>& corners) const;

  double dilation(const glm::dvec2& uv) const;
  double narrow() const { return options_.narrow; }

 private:
  double extent(double h, double end, double far_height) const;
  void grow(std::array<Uvh, 3>& corners) const;

  const TriangleMesh& mesh_;
  const LightSpace& space_;
  const Supports& supports_;
  const FootprintOptions& options_;
};

template <std::size_t n>
UvBounds uv_bounds_of(const std::array<Uvh, n>& corners) {
  UvBounds out;
  for (const Uvh& c : corners) out.add(c.uv);
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
