// Silhouette method, step 4 of 5: segments cut to what the receiver sees of the disk, and the exact integral of
// the number of hiding faces over it.
//
// Let L(p) be the number of faces over p ∈ D, relative to that at D's lowest point. By Green's theorem
//   ∫_D L = Σ_segments jump ∫ (x dy - y dx)/2 - Σ_events change · walked(event),
// with the events where segments cross D's boundary (disk_part.h): no order, no arrangement. Where
// only two depth complexities occur, that is the visible area itself; see visible_area.h.
//
// Cutting is watertight: whether an end is inside is decided for the end alone, the same in all segments that
// share it, and a segment with one end inside makes exactly one event. The point on the rim comes from the
// line's distance to the center, so that it is as exact for ends far away.
#pragma once

#include <span>
#include <vector>

#include "render/silhouette/areas/disk_part.h"
#include "render/silhouette/areas/projected_edges.h"

namespace penumbra::detail {

struct ClippedSegments {
  std::vector<Segment> segments;  ///< inside D
  std::vector<Event> events;
  double integral = 0.0;  ///< ∫ L over D
  bool closed = true;     ///< the events' changes add up to 0, as they do unless edges were lost
};

/// The first `inside` segments are known to have both ends inside D.
void clip_segments(std::span<const Segment> segments, std::size_t inside, const DiskPart& part,
                   ClippedSegments& out);

/// True where only two depth complexities can occur: one chain of segments that enters and leaves D once and never turns
/// by a right angle or more from its general direction, hence never crosses itself. With `folds` above 0 it
/// may turn back, but so little that other depth complexities, which then occur where it does, cannot take up more of D's
/// area than that; not with more than 128 segments. Cost O(segments), times those that go back.
bool is_one_chain(const ClippedSegments& clipped, double folds = 0.0);

}  // namespace penumbra::detail
