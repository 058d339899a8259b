// Silhouette method, step area: the area of the part of the disk that nothing hides.
//
// In: clipped segments, and the part D of the disk above the horizon. Out: the area at the lowest depth
// complexity, and two points there. L(p) is the number of faces that hide p, relative to D's lowest point.
// Where L is lowest nothing hides p, or else everything is hidden: one ray to such a point tells. There are
// three ways, by what the segments are like.
//
// Chain: one chain of segments crosses D once without turning back. There are two depth complexities, and
// the exact integral of L (clip_segments.h) gives the area.
//
// Slabs, for few segments: their ends and crossings divide D into slabs between heights. Within a slab
// segments do not cross, and each interval between neighbors is a trapezoid. Its area is its width at the
// middle height times the height of the slab; at the rim the mean of √(1-y²) over the slab takes the place
// of the width. This is exact for any number of depth complexities.
//
// Rows, for many segments: scanlines at even distances with exact intervals (rows.h) give an area A_k for
// every depth complexity k, good to their spacing. The exact integral of L corrects the area of the lowest
// as a control variate. With p its share,
//   area = |D| p + c (∫ L - |D| mean L),   c = cov(lowest?, L) / var L   under the areas A_k.
// Again this is exact where only two depth complexities occur, so that rows only have to measure the
// overlap. Where rows and integral disagree by much, four times as many rows are swept.
//
// Slivers: silhouettes of merged faces (merge/merged_edges.h) turn back here and there, in slivers that the
// true silhouettes do not have, at depth complexities that may lie below the true lowest. These are left
// out of account. A chain may turn back by as much (`is_one_chain`). Where there are several chains a few
// rows tell whether there are two depth complexities but for slivers, and then the integral gives the area.
//
// Aims: rays go to two points of the lowest depth complexity, far from the segments. The second serves
// where the first is hidden, since one point may happen to lie near an edge.
#pragma once

#include <array>

#include "render/silhouette/areas/rows.h"

namespace penumbra::detail {

enum class AreaMethod { kChain, kSlabs, kRows };

struct VisibleAreaResult {
  /// At the lowest depth complexity, 0 to |D|.
  double area = 0.0;
  /// How many depth complexities were met.
  int complexities = 1;
  /// Two points at the lowest depth complexity, or twice the same.
  std::array<glm::dvec2, 2> aims;
  AreaMethod method = AreaMethod::kChain;
};

/// Computes areas for one receiver after the other, with memory kept between them.
class VisibleArea {
 public:
  /// Replaces `out`. `rows`: how many scanlines where there are many segments. `sliver`: the share of D's
  /// area up to which a lowest depth complexity counts as the next one; 0 for true silhouettes. Cost for s
  /// segments: s for a chain, s² for slabs, and for rows that of `Rows::sweep`.
  void compute(const ClippedSegments& clipped, const DiskPart& part, int rows, double sliver,
               VisibleAreaResult& out);

  // The ways one by one, which tests compare.
  VisibleAreaResult by_slabs(const ClippedSegments& clipped, const DiskPart& part, double sliver = 0.0);
  VisibleAreaResult by_rows(const ClippedSegments& clipped, const DiskPart& part, int rows,
                            double sliver = 0.0);
  /// True where a few rows find two depth complexities but for slivers and agree with the integral of L;
  /// the integral then gives the area.
  bool by_few_rows(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                   VisibleAreaResult& out);

 private:
  /// A segment, upwards: heights of its ends, x at the lower one, dx/dy, and the change of L from left to
  /// right.
  struct Line {
    double low, high, x, slope;
    int change;
    double at(double y) const { return x + slope * (y - low); }
  };
  struct Crossing {
    double x;
    int change;
  };
  /// The middle of an interval in a slab, its length × height, and its length + height.
  struct Aim {
    double area = 0.0, reach = 1.0;
    glm::dvec2 at{0.0};
    double room() const { return area / reach; }
  };
  /// The middle height of a slab, its height, its ends at the middle, and L at the left end.
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
  /// Heights between slabs, and ∫ √(1-y²) dy up to them.
  std::vector<double> heights_, rim_;
  std::vector<Crossing> crossings_;
  /// By depth complexity, from -kMostComplexity up; 0 between uses.
  std::vector<double> areas_;
  /// At the lowest depth complexity so far, in slabs of either parity.
  std::array<Aim, 2> aims_;
  /// Depth complexities below `least_` count as that.
  int least_ = 0, lowest_ = 0, highest_ = 0, parity_ = 0;
};

/// The area beside one chain in closed form, and false where there is no such chain, or little room beside
/// it for a ray. `sliver` as for VisibleArea::compute.
bool area_by_chain(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                   VisibleAreaResult& out);

}  // namespace penumbra::detail
