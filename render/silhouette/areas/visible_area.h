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
// Slabs, for few segments: an exact sweep (slabs.h).
//
// Rows, for many segments: two families of scanlines in two directions, at irregular heights (rows.h), give
// an area A_k for every depth complexity k, good to their spacing. The exact integral of L corrects the area
// of the lowest as a control variate. With p its share,
//   area = |D| p + c (∫ L - |D| mean L),   c = cov(lowest?, L) / var L   under the areas A_k.
// This is exact where only two depth complexities occur, so that rows only have to measure the overlap. The
// mean of both families counts, if they agree: on the lowest depth complexity, on its area, and each with the
// integral of L. Where they do not, something regular keeps step with a family, or is so thin that rows miss
// it. Then slabs are swept, as many as twice the rows would cost, or else twice as many rows, and so on up to
// sixteen times. What is left after that is said in the result.
//
// Slivers: silhouettes of merged faces (merge/merged_edges.h) turn back here and there, in slivers that the
// true silhouettes do not have, at depth complexities that may lie below the true lowest. These are left out
// of account. A chain may turn back by as much (`is_one_chain`). Where there are several chains a few rows of
// both families tell whether there are two depth complexities but for slivers, and then the integral gives
// the area.
//
// Aims: rays go to two points of the lowest depth complexity, far from the segments. The second serves
// where the first is hidden, since one point may happen to lie near an edge.
#pragma once

#include <array>

#include "render/silhouette/areas/rows.h"
#include "render/silhouette/areas/slabs.h"

namespace penumbra::detail {

/// How many numbers of rows are tried.
inline constexpr std::size_t kRowLevels = 4;

enum class AreaMethod { kChain, kSlabs, kRows };

struct VisibleAreaResult {
  /// At the lowest depth complexity, 0 to |D|.
  double area = 0.0;
  /// How many depth complexities were met.
  int complexities = 1;
  /// Two points at the lowest depth complexity, or twice the same.
  std::array<glm::dvec2, 2> aims;
  AreaMethod method = AreaMethod::kChain;
  /// Families of rows agreed, or did not need to.
  bool resolved = true;
};

/// Computes areas for one receiver after the other, with memory kept between them.
class VisibleArea {
 public:
  VisibleArea();

  /// Replaces `out`. `rows`: how many scanlines of each direction where there are many segments. `sliver`:
  /// the share of D's area up to which a lowest depth complexity counts as the next one; 0 for true
  /// silhouettes. Cost for s segments: s for a chain, else that of `Slabs` and `Rows`.
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
  /// Two families that share neither direction nor heights.
  using Families = std::array<Rows, 2>;

  bool find_and_sweep_slabs(const ClippedSegments& clipped, const DiskPart& part, std::size_t most,
                            double sliver, VisibleAreaResult& out);

  Slabs slabs_;
  RowMemory memory_;
  /// One family where it is enough; both with three quarters of the rows, with two, four and sixteen times as
  /// many; both with few rows. Each keeps its heights.
  Rows alone_;
  std::array<Families, kRowLevels> families_;
  Families few_;
};

/// The area beside one chain in closed form, and false where there is no such chain, or little room beside
/// it for a ray. `sliver` as for VisibleArea::compute.
bool area_by_chain(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                   VisibleAreaResult& out);

}  // namespace penumbra::detail
