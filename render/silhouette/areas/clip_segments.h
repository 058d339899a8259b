// Silhouette method, step clip: segments clipped to what a receiver sees of the disk, and the integral of
// the number of hiding faces over it.
//
// In: projected segments, and the part D of the disk above the horizon. Out: the segments inside D, the
// events where they cross D's boundary, and ∫ L. L(p) is the number of faces that hide p, its depth
// complexity, relative to that at D's lowest point. By Green's theorem
//   ∫_D L = Σ_segments jump ∫ (x dy - y dx)/2 - Σ_events change · walked(event),
// without any order of the segments, and without an arrangement. Where only two depth complexities occur
// this gives the visible area (visible_area.h).
//
// Clipping is watertight. Whether an end is inside is decided for that end alone, so all segments that
// share it agree. A segment with one end inside makes exactly one event. The point on the rim comes from
// the distance of the line from the center, so it is as exact for ends far away.
#pragma once

#include <span>
#include <vector>

#include "render/silhouette/areas/disk_part.h"
#include "render/silhouette/areas/projected_edges.h"

namespace penumbra::detail {

struct ClippedSegments {
  /// Inside D.
  std::vector<Segment> segments;
  std::vector<Event> events;
  /// ∫ L over D.
  double integral = 0.0;
  /// The events' changes add up to 0, as they do unless edges were lost.
  bool closed = true;
};

/// Replaces `out`. The first `inside` segments are known to have both ends inside D. Cost O(segments).
void clip_segments(std::span<const Segment> segments, std::size_t inside, const DiskPart& part,
                   ClippedSegments& out);

/// True where only two depth complexities can occur: one chain of segments enters and leaves D once, and no
/// segment turns by a right angle or more from the chain's general direction. Then the chain never crosses
/// itself.
///
/// With `folds` above 0 the chain may turn back, if it has 128 segments or fewer. Where it does other depth
/// complexities occur; true only if these cannot take up more of D's area than `folds`. Cost O(segments),
/// times the number of segments that go back.
bool is_one_chain(const ClippedSegments& clipped, double folds = 0.0);

}  // namespace penumbra::detail
