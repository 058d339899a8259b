// The D-buffer's own geometry: facets and cone sectors as seen from the light's center.
//
// In the coordinates (u, v, w) = (x/z, y/z, 1/z) of the light's frame everything is flat: the plane that
// touches the disk of radius r at rim angle φ is w = (cos φ u + sin φ v + κ)/r, of slope 1/r for every edge,
// and the boundary at a vertex is a circular cone of that slope. So depth is linear on the screen and needs
// no per-pixel correction (the 2004 paper, section 3.2, interpolates distances and accepts the error).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "render/facet_reach.h"
#include "volumes/supports.h"

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

struct EntryVertex {
  float u, v, w;
  std::uint32_t facet;  ///< index into EntryGeometry::records / 4
  float edge_weight;    ///< 1/z of the edge's point from which this line of the boundary starts
};

struct EntryGeometry {
  std::vector<EntryVertex> penumbra, umbra;  ///< triangles, three vertices each
  /// Four points a facet, light's frame: previous, a, b, next (directed so that the lit side is positive);
  /// the fourth number of the outer two is 1 + the previous or next facet; 0: none.
  std::vector<glm::vec4> records;
};

/// One caster and where its shadow is bounded.
struct EntrySource {
  const TriangleMesh& mesh;
  const LightSpace& space;
  const Supports& supports;
  const std::vector<GapFace>& gaps;
  const FacetReach& reach;
};

struct EntryGeometryOptions {
  double near_depth;   ///< edges are cut at this depth
  double far_weight;   ///< 1/z of the farthest receiver: facets end there
  double dilation;     ///< in (u, v): facets grow by this to all sides, to reach every texel they touch
  bool grows_with_uv;  ///< times 1 + |uv|, as the texels of a hemicube do
};

/// Adds one caster. Cost O(facets + cone segments).
void append_entry_geometry(const EntrySource& source, const EntryGeometryOptions& options,
                           EntryGeometry& out);

/// Puts triangles in the order of their own numbers, nearest to the light first, so that which of two at the
/// same depth is kept depends on where they are and not on how the mesh lists them. Cost O(n log n).
void sort_by_geometry(EntryGeometry& entries);

}  // namespace penumbra::detail
