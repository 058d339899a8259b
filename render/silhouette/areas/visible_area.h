// Silhouette method, step 5 of 5: depth complexities over the disk, and the area of the lowest.
//
// L(p) is the number of faces that hide p, relative to D's lowest point; its lowest depth complexity is what nothing
// hides, or else everything is hidden (one ray tells). Three ways, by what the segments are like:
//
// - One chain that crosses D once without turning back (`chain`): two depth complexities, and the exact integral of L
//   (clip_segments.h) gives the area.
// - Few segments: their ends and crossings divide D into slabs between heights. Within a slab segments do not
//   cross, each interval between neighbors is a trapezoid, and its width at the middle times the slab's
//   height is its area; at the rim the slab's mean of √(1-y²) takes the place of the width. Exact for any
//   number of depth complexities.
// - Many segments: rows at even distances with exact intervals, an area A_k for every depth complexity k, good to the
//   rows' spacing. The exact integral of L corrects the area of the lowest depth complexity as a control variate: with p
//   its share,
//     area = |D| p + c (∫ L - |D| mean L),   c = cov(lowest?, L) / var L   under the areas A_k,
//   which is exact again where only two depth complexities occur; rows only have to measure the overlap. Where the two
//   disagree by much, four times as many rows are swept.
//
// Silhouettes of merged faces (merged_edges.h) turn back here and there, in slivers that the true ones do not
// have, at depth complexities that may lie below the true lowest. They are left out of account: a chain may turn back by
// as much (`is_one_chain`), and where there are several chains few rows tell whether there are two depth complexities,
// and then the integral is the answer.
//
// Rays aim at two points of the lowest depth complexity far from the segments; the second serves where the first is
// hidden, since a point may happen to lie near an edge.
#pragma once

#include <array>

#include "render/silhouette/areas/rows.h"

namespace penumbra::detail {

enum class AreaMethod { kChain, kSlabs, kRows };

struct VisibleAreaResult {
  double area = 0.0;               ///< of the lowest depth complexity, 0 to |D|
  int complexities = 1;            ///< how many were met
  std::array<glm::dvec2, 2> aims;  ///< two points of the lowest depth complexity
  AreaMethod method = AreaMethod::kChain;
};

/// For one receiver after the other, with memory kept between them.
class VisibleArea {
 public:
  /// Into `out`, all of it. `rows`: how many where there are many segments. `sliver`: a lowest depth complexity whose
  /// share of D's area is that or less is none, and counts as the next; 0 for true silhouettes. Cost for s
  /// segments: s for a chain, s² for slabs; of rows see rows.h.
  void compute(const ClippedSegments& clipped, const DiskPart& part, int rows, double sliver,
               VisibleAreaResult& out);

  VisibleAreaResult by_slabs(const ClippedSegments& clipped, const DiskPart& part, double sliver = 0.0);
  VisibleAreaResult by_rows(const ClippedSegments& clipped, const DiskPart& part, int rows,
                            double sliver = 0.0);
  /// Where a few rows find two depth complexities but for slivers, and agree with the integral of L; else false.
  bool by_few_rows(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                   VisibleAreaResult& out);

 private:
  struct Line {  ///< a segment upwards
    double low, high, x, slope;
    int change;  ///< of L from left to right
    double at(double y) const { return x + slope * (y - low); }
  };
  struct Crossing {
    double x;
    int change;
  };
  struct Aim {
    double area = 0.0, reach = 1.0;  ///< of the interval: length × height, length + height
    glm::dvec2 at{0.0};
    double room() const { return area / reach; }
  };
  struct Slab {
    double y, height, left, right;
    int first_complexity;
  };

  void add_line(const Segment& segment);
  void make_heights(const DiskPart& part, const ClippedSegments& clipped);
  RowSums sweep_rows(const ClippedSegments& clipped, const DiskPart& part, int rows, double sliver);
  void begin(int least);
  void sweep_slabs(const ClippedSegments& clipped, const DiskPart& part, int least);
  void forget_areas();
  void sort_crossings();
  void sweep(const Slab& slab);
  void add_interval(const Slab& slab, double from, double to, int complexity);
  VisibleAreaResult finish() const;

  Rows rows_;
  std::vector<Line> lines_;
  std::vector<double> heights_, rim_;  ///< and the rim's integral up to them
  std::vector<Crossing> crossings_;
  std::vector<double> areas_;  ///< by depth complexity
  std::array<Aim, 2> aims_;    ///< in the lowest depth complexity so far, in slabs of either parity
  int least_ = 0, lowest_ = 0, highest_ = 0, parity_ = 0;  ///< lower depth complexities count as the least
};

/// Closed form for one chain; false where it is none, or where there is little room beside it for a ray.
/// Depth complexities in slivers are left out of account, as in VisibleArea::compute.
bool area_by_chain(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                   VisibleAreaResult& out);

}  // namespace penumbra::detail
