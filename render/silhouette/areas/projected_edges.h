// Silhouette method, step project: the edges that one receiver sees near the disk, and the certificate.
//
// In: a tile's edges, or edges of blocks that passed the edge test; a receiver x and its horizon. Out: the
// segments in the plane of the disk that are near, have a jump, and are not wholly below the horizon.
// edges/projected_segment.h defines this for one edge. Here it is done in vectors wherever an edge lies
// below the receiver and floats were sure of its jump.
//
// The certificate: if no edge of the band meets the disk, seen from x, the number of faces between x and
// the disk is the same for all points of the disk. So x is wholly lit or wholly in umbra, and one ray tells
// which.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/light/disk_area.h"
#include "render/silhouette/collect/edge_list.h"
#include "render/silhouette/edges/projected_segment.h"

namespace penumbra::detail {

/// What one receiver sees, and memory that is kept between receivers.
struct ProjectedEdges {
  std::vector<Segment> segments;
  /// Both ends of so many segments, the first ones, lie in the disk and above the horizon.
  std::size_t inside = 0;
  /// No edge is near, with a jump or without: the certificate.
  bool certain = false;
  void clear();

  // Working memory.
  TestedEdges tested;
  /// Of projections: a.x, a.y, b.x, b.y.
  std::array<std::vector<double>, 4> ends;
  std::vector<std::int64_t> states;
  std::vector<Segment> crossing;
};

/// The edges of a list. Replaces `out`. Cost: that of `test_edges`, and some 60
/// flops an edge that it leaves.
void project_edges(const EdgeList& list, const Vec3& x, const Chord& horizon, const Rounding& rounding,
                   ProjectedEdges& out);
/// The edges of the band that passed the edge test of EdgeBlocks. `tested` may be that of `out`.
void project_edges(const Band& band, const TestedEdges& tested, const Vec3& x, const Chord& horizon,
                   const Rounding& rounding, ProjectedEdges& out);

}  // namespace penumbra::detail
