// Silhouette method, step 3 of 5: the edges of a tile's list as one receiver sees them, and the certificate.
//
// In: a tile's edges, a receiver x. Out: the segments that may cross the disk with a jump that is not 0,
// projected from x onto the plane of the disk: p → x + (p - x) x.z/(x.z - p.z). What an edge hides beyond x
// does not count, so edges are cut just below x's height (a hair of 2^-23 x.z, from where they project to
// infinity for the disk's purposes).
//
// Certificate: if no edge of the band meets the disk, seen from x, the number of faces between x and the disk
// is the same for all of its points; x is wholly lit or wholly in umbra, and one ray tells which. Edges are
// only dismissed with a margin that covers rounding: an edge is near where it comes within `slack` of the
// disk and its jump is not certainly 0. Errors of coordinates, at most u M each, grow by x.z/w, w = x.z -
// p.z; the point of the segment that is nearest to the disk, computed from ends at most 2^24 M away, is off
// by less than 2^-53 2^24 M times a small number: slack = 1e-6 + 2^-26 M bounds both.
//
// `project_edge` is the definition, for one edge; `project_edges` does the same for a list, in vectors wherever an edge lies
// below the receiver and floats were sure of its jump.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/light/disk_area.h"
#include "render/silhouette/collect/edge_list.h"

namespace penumbra::detail {

/// A segment in the plane of the disk, seen from the light's front; left minus right of a → b.
struct Segment {
  glm::dvec2 a, b;
  int jump;
};

struct Projection {
  Segment segment;
  bool near;  ///< may meet the disk with a jump, by the certificate's margin
};
/// An end that two edges share projects to the same bits in both.
Projection project_edge(const BandEdge& edge, const Vec3& x, double slack);

double certificate_slack(double extent);

/// What one receiver sees: the segments that are near, have a jump, and are not wholly below its horizon.
struct ProjectedEdges {
  std::vector<Segment> segments;
  std::size_t inside = 0;  ///< so many come first whose ends both lie in the disk and above the horizon
  bool certain = false;    ///< no edge of the list meets the disk
  void clear();

  // Working memory.
  TestedEdges tested;
  std::array<std::vector<double>, 4> ends;  ///< of projections: a.x, a.y, b.x, b.y
  std::vector<std::int64_t> states;
  std::vector<Segment> crossing;
};
void project_edges(const EdgeList& list, const Vec3& x, const Chord& horizon, double slack,
                   ProjectedEdges& out);
/// The same for edges of the band that were tested in blocks.
void project_edges(const Band& band, const TestedEdges& tested, const Vec3& x, const Chord& horizon,
                   double slack, ProjectedEdges& out);

}  // namespace penumbra::detail
