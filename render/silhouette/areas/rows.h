// Silhouette method, in step 5: scanlines across the disk with exact intervals, for many segments.
//
// In: segments inside D, at which the number L of hiding faces changes. Out: how long each row lies at L, as
// far as fusing asks (visible_area.h): the lowest depth complexity and its length, and the moments of L. Rows are
// lanes: their crossings are sorted and swept many rows at a time, without branches, as many as the processor
// has lanes (real_lanes.h). A crossing is one
// number, its x with the change of L in the last three bits of the mantissa, so that sorting moves both.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/silhouette/areas/clip_segments.h"

namespace penumbra::detail {

struct RowSums {
  double length = 0.0, first = 0.0, second = 0.0;  ///< Σ length · L^k over all intervals, k = 0, 1, 2
  double lowest = 0.0;                             ///< the lowest depth complexity
  double lowest_length = 0.0;
  int complexities = 0;  ///< how many were met
  std::array<glm::dvec2, 2>
      aims;  ///< middles of long intervals at the lowest depth complexity, in rows of either parity
};

/// Rows that lie next to each other in memory and are swept together.
inline constexpr int kRowLanes = 8;

/// One crossing of each of some neighboring rows.
struct alignas(kRowLanes * sizeof(double)) RowKeys {
  std::array<double, kRowLanes> x;
};

/// Some neighboring rows before their first crossing.
struct RowStarts {
  const double *left, *right;  ///< ends
  const double* complexity;    ///< L at the left ends
  double least;                ///< lower depth complexities count as this
};

/// The same rows behind their last one.
struct alignas(kRowLanes * sizeof(double)) RowResults {
  using Numbers = std::array<double, kRowLanes>;
  Numbers length, first, second, lowest, lowest_length;  ///< as in RowSums
  Numbers best, middle;                      ///< of the longest interval at the lowest depth complexity
  std::array<std::int64_t, kRowLanes> seen;  ///< bit L mod 64 for each depth complexity met
};

/// For one receiver after the other, with memory kept between them.
class Rows {
 public:
  static constexpr double kNoLeast = -1e9;
  /// `rows` at even distances across D; depth complexities below `least` count as that. Cost for s segments with c
  /// crossings, at most m in a row: s + c + rows m².
  RowSums sweep(const ClippedSegments& clipped, const DiskPart& part, int rows, double least = kNoLeast);
  /// The same with rows sorted one by one and code for any processor: the same bits, for tests.
  RowSums sweep_singly(const ClippedSegments& clipped, const DiskPart& part, int rows,
                       double least = kNoLeast);

 private:
  struct CrossingSegment {
    const Segment* segment;
    int from, to;  ///< the rows above its ends
  };
  struct Sums {
    RowSums sums;
    std::array<double, 2> best{};
    std::uint64_t seen = 0;
  };

  int row_above(double y) const;
  void place_rows(const DiskPart& part, int rows);
  void find_crossing(const ClippedSegments& clipped);
  void cross(const ClippedSegments& clipped);
  void start_complexities(const ClippedSegments& clipped, const DiskPart& part);
  RowStarts starts(int first) const;
  void add(const RowResults& rows, int first, Sums& sums) const;
  template <class Sweep>
  RowSums sweep_with(const ClippedSegments& clipped, const DiskPart& part, int rows, double least,
                     const Sweep& sweep_from);

  int rows_ = 0;
  double least_ = kNoLeast;
  std::size_t stride_ = 0;  ///< rows, rounded up
  double bottom_ = 0.0, spacing_ = 0.0, per_spacing_ = 0.0;
  bool whole_disk_ = false;  ///< the ends of rows are those of the whole disk
  std::vector<double> heights_, left_, right_;
  std::vector<double> complexities_;       ///< at left ends
  std::vector<CrossingSegment> crossing_;  ///< the first crossing_count_
  std::size_t crossing_count_ = 0;
  std::vector<std::size_t> next_;  ///< where each row's next key belongs, in numbers
  std::vector<int> longest_;       ///< the most crossings of a row, of some rows that are swept together
  std::size_t most_ = 1;           ///< keys a row
  std::vector<RowKeys>
      keys_;  ///< crossing k of row i is lane i mod kRowLanes of number i/kRowLanes · most + k
};

}  // namespace penumbra::detail
