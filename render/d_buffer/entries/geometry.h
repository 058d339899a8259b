// D-buffer step 4: facets, cone sectors and gap faces as triangles to draw, and a record a facet for the
// shader.
//
// In: footprints, reach, who will read the D-buffer. Out: EntryGeometry. In the coordinates of
// light_space.h everything is flat, so depth is linear on the screen. The 2004 paper (section 3.2)
// interpolates distances, which are not, and accepts the error. Gap faces are the paper's silhouette faces
// (section 3.3).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "render/d_buffer/entries/entry_footprint.h"

namespace penumbra::detail {

struct EntryVertex {
  /// (u, v, h, 1) · a positive number, so that no number is greater than 1: a corner may be very far away.
  glm::vec4 place;
  /// Number of its facet: the record is EntryGeometry::records[4 · facet] and the three after it.
  std::uint32_t facet;
  /// h of the edge's point from which this line of the boundary starts.
  float edge_height;
};

struct EntryGeometry {
  /// Triangles, three vertices each.
  std::vector<EntryVertex> penumbra, umbra;
  /// Four points (u, v, h) a facet: the begin of the previous edge, the edge's ends a and b, the end of the
  /// next edge, as far as they are kept (EntryFootprints::segment). Directed so that the lit side is positive
  /// (SupportFacet::flipped). The fourth number of the first point is 1 + the previous facet, of the last 1 +
  /// the next; 0: none.
  std::vector<glm::vec4> records;
};

/// One caster's boundary, and who reads of it.
struct EntrySource {
  const EntryFootprints& footprints;
  const Supports& supports;
  const std::vector<GapFace>& gaps;
  const FacetReach& reach;
  const ReceiverGrid& receivers;
};

/// Adds one caster. What no receiver reads is left out, what goes on behind the last of them is cut short.
/// Cost O(facets + cone segments), on all cores.
void append_entry_geometry(const EntrySource& source, EntryGeometry& out);

/// Sorts the triangles by their own coordinates, nearest to the light first. Which of two at the same depth a
/// texel keeps then depends on where they are, not on how the mesh lists them. Cost O(n log n), on all cores.
void sort_by_geometry(EntryGeometry& entries);

}  // namespace penumbra::detail
