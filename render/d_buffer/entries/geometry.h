// The D-buffer's own geometry: facets and cone sectors as seen from the light's center.
//
// In the coordinates of entry_footprint.h everything is flat, so depth is linear on the screen and needs no
// per-pixel correction (the 2004 paper, section 3.2, interpolates distances and accepts the error).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "render/d_buffer/entries/entry_footprint.h"

namespace penumbra::detail {

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

/// One caster's boundary, and who reads of it.
struct EntrySource {
  const EntryFootprints& footprints;
  const Supports& supports;
  const std::vector<GapFace>& gaps;
  const FacetReach& reach;
  const ReceiverGrid& receivers;
};

/// Adds one caster; what no receiver reads is left out, and what goes on behind them cut short. Cost
/// O(facets + cone segments).
void append_entry_geometry(const EntrySource& source, EntryGeometry& out);

/// Puts triangles in the order of their own numbers, nearest to the light first, so that which of two at the
/// same depth is kept depends on where they are and not on how the mesh lists them. Cost O(n log n).
void sort_by_geometry(EntryGeometry& entries);

}  // namespace penumbra::detail
