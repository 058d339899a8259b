// Silhouette method, step area: the exact sweep.
//
// In: segments inside D. Out: sums as of rows, exact for any number of depth complexities.
//
// The ends of segments, their crossings, and the corners of D's boundary divide D into slabs between heights.
// Within a slab segments do not cross, and each interval between neighbors is a trapezoid. Its area is its
// width at the middle height times the height of the slab; at the rim the mean of √(1-y²) over the slab takes
// the place of the width. A slab needs no order that is known from the slab below: what rounding makes of a
// crossing costs no more than the area that is rounded.
#pragma once

#include <cstddef>
#include <vector>

#include "render/silhouette/areas/clip_segments.h"
#include "render/silhouette/areas/scanlines.h"

namespace penumbra::detail {

/// Sweeps one receiver after the other, with memory kept between them.
class Slabs {
 public:
  /// Finds the slabs. False where there are more than `most` of them. Cost for s segments with p pairs at
  /// common heights and c crossings: s log s + p + (s + c) log(s + c).
  bool find(const ClippedSegments& clipped, const DiskPart& part, std::size_t most);
  /// The sums over the slabs that were found, of the same segments. Depth complexities below `least` count as
  /// that. Cost for m segments at a height: (s + c) · m log² m.
  LineSums sweep(const ClippedSegments& clipped, const DiskPart& part, double least = -LineSums::kNone);

 private:
  /// Segments upwards, member by member: heights of their ends, x at the lower one, dx/dy, and the change of
  /// L from left to right.
  struct Lines {
    std::vector<double> low, high, x, slope;
    std::vector<int> change;
    void clear();
    void add(const Segment& segment);
    std::size_t size() const { return low.size(); }
  };

  void sort_lines(const ClippedSegments& clipped);
  bool add_crossings(std::size_t most);
  void place(std::size_t first, const DiskPart& part, Scanlines& lines) const;
  void start_complexities(const ClippedSegments& clipped, const DiskPart& part, Scanlines& lines) const;
  int cross(double low, double high, const Scanlines& lines);

  Lines lines_;
  /// Whether lines ascend by their lower ends.
  bool sorted_ = false;
  /// Heights between slabs, and ∫ √(1-y²) dy up to them.
  std::vector<double> heights_, rim_;
  /// Working memory: crossings of a line with those behind it; lines at the heights at hand; lines by their
  /// lower ends.
  std::vector<double> crossings_;
  std::vector<std::size_t> active_;
  std::size_t next_ = 0;
  std::vector<const Segment*> order_;
  std::vector<CrossingKeys> keys_;
};

}  // namespace penumbra::detail
