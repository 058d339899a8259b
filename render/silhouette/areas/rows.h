// Silhouette method, step area: scanlines across the disk with exact intervals, for many segments.
//
// In: segments inside D, at which the depth complexity L changes. Out: the lowest depth complexity, the
// length over which rows lie at it, and the moments of L over the rows (visible_area.h).
//
// Rows are lanes. Their crossings are sorted and swept many rows at a time, without branches, as many as
// the processor has lanes (support/real_lanes.h). A crossing is one number, its x with the change of L in
// the last three bits of the mantissa, so that sorting moves both.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/silhouette/areas/clip_segments.h"

namespace penumbra::detail {

/// Sums over the intervals between crossings in all rows.
struct RowSums {
  /// Σ length · L^k, k = 0, 1, 2.
  double length = 0.0, first = 0.0, second = 0.0;
  /// The lowest depth complexity, and the length of its intervals.
  double lowest = 0.0, lowest_length = 0.0;
  /// How many depth complexities were met.
  int complexities = 0;
  /// The middles of long intervals at the lowest depth complexity, in even and in odd rows, the longer first.
  std::array<glm::dvec2, 2> aims;
};

/// As many rows as lie next to each other in memory and are swept together.
inline constexpr int kRowLanes = 8;

/// One crossing of each of kRowLanes neighboring rows.
struct alignas(kRowLanes * sizeof(double)) RowKeys {
  std::array<double, kRowLanes> x;
};

/// kRowLanes neighboring rows before their first crossing.
struct RowStarts {
  /// The ends of the rows, and L at the left ends.
  const double *left, *right, *complexity;
  /// Lower depth complexities count as this.
  double least;
};

/// The same rows behind their last crossing.
struct alignas(kRowLanes * sizeof(double)) RowResults {
  using Numbers = std::array<double, kRowLanes>;
  /// As in RowSums, for each row.
  Numbers length, first, second, lowest, lowest_length;
  /// The length and the middle of the longest interval at the lowest depth complexity.
  Numbers best, middle;
  /// Bit L mod 64 is set for each depth complexity L that was met.
  std::array<std::int64_t, kRowLanes> seen;
};

/// Sweeps the rows of one receiver after the other, with memory kept between them.
class Rows {
 public:
  static constexpr double kNoLeast = -1e9;
  /// `rows`: how many, at even distances across D. Depth complexities below `least` count as that. Cost for
  /// s segments with c crossings, at most m in a row: s + c + rows · m log² m.
  RowSums sweep(const ClippedSegments& clipped, const DiskPart& part, int rows, double least = kNoLeast);
  /// The same with rows sorted one by one and code for any processor: the same bits, for tests.
  RowSums sweep_singly(const ClippedSegments& clipped, const DiskPart& part, int rows,
                       double least = kNoLeast);

 private:
  /// A segment, and the rows above its ends.
  struct CrossingSegment {
    const Segment* segment;
    int from, to;
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
  /// rows_, rounded up to kRowLanes.
  std::size_t stride_ = 0;
  double bottom_ = 0.0, spacing_ = 0.0, per_spacing_ = 0.0;
  /// The rows are placed for the whole disk.
  bool whole_disk_ = false;
  std::vector<double> heights_, left_, right_;
  /// L at the left ends.
  std::vector<double> complexities_;
  /// The first crossing_count_ are in use.
  std::vector<CrossingSegment> crossing_;
  std::size_t crossing_count_ = 0;
  /// Where the next key of each row belongs, counted in numbers.
  std::vector<std::size_t> next_;
  /// The most crossings of a row, for each kRowLanes rows.
  std::vector<int> longest_;
  /// Keys of a row.
  std::size_t most_ = 1;
  /// Crossing k of row i is lane i mod kRowLanes of entry i/kRowLanes · most_ + k.
  std::vector<RowKeys> keys_;
};

}  // namespace penumbra::detail
