// Silhouette method, step area: families of rows, for many segments.
//
// In: segments inside D, at which the depth complexity L changes, and a direction. Out: sums over scanlines
// in that direction at the heights of row_heights.h. L is relative to D's lowest point whatever the direction
// is, so the sums of two families can be compared with each other and with the integral of L.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/silhouette/areas/clip_segments.h"
#include "render/silhouette/areas/row_heights.h"
#include "render/silhouette/areas/scanlines.h"

namespace penumbra::detail {

/// By which D is turned before it is swept, so that rows lie along (cosine, -sine).
struct Turn {
  double cosine = 1.0, sine = 0.0;

  glm::dvec2 operator()(const glm::dvec2& p) const {
    return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  }
  glm::dvec2 back(const glm::dvec2& p) const {
    return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x};
  }
};

/// What sweeps leave in memory for the next.
struct RowMemory {
  /// Rows whose crossings are kept at a time.
  static constexpr int kMostTogether = 4 * kScanlines;

  /// The rows above the ends of segments; segments that cross some of the rows.
  std::vector<int> row_a, row_b, crossing;
  /// Heights of events as shares of that of D, and the changes of L at the left ends between rows.
  std::vector<double> shares;
  std::vector<int> changes;
  /// Heights between strips, and the integral of the rim up to them.
  std::vector<double> bounds, rim;
  /// Where the rows at hand are, where the next key of each belongs, counted in numbers, and how many it has.
  alignas(64) std::array<double, kMostTogether + kScanlines> y{};
  alignas(64) std::array<std::int32_t, kMostTogether + kScanlines> next{}, counts{};
  /// Crossing k of row i is lane i mod 16 of entry i/16 · stride + k.
  std::vector<CrossingKeys> keys;
  int stride = 1;
};

/// One family, for one receiver after the other.
class Rows {
 public:
  /// `family`: of RowHeights.
  Rows(const Turn& turn, int family) : turn_(turn), family_(family), heights_(1, family) {}

  /// `rows`: how many; where they are is kept for the next receiver. Depth complexities below `least` count
  /// as that. Cost for s segments with c crossings, at most m in a row: s + c + rows · m log² m.
  LineSums sweep(const ClippedSegments& clipped, const DiskPart& part, int rows, RowMemory& memory,
                 double least = -LineSums::kNone);
  /// The same with rows sorted one by one and code for any processor: the same bits, for tests.
  LineSums sweep_singly(const ClippedSegments& clipped, const DiskPart& part, int rows, RowMemory& memory,
                        double least = -LineSums::kNone);

 private:
  void place(const DiskPart& turned, int rows, RowMemory& m);
  void find_rows(const ClippedSegments& clipped, RowMemory& m) const;
  void cross(const ClippedSegments& clipped, int first, int last, RowMemory& m) const;
  void start_complexities(const ClippedSegments& clipped, const DiskPart& part, const DiskPart& turned,
                          RowMemory& m);
  template <class Sweep>
  LineSums sweep_with(const ClippedSegments& clipped, const DiskPart& part, int rows, RowMemory& m,
                      const Sweep& sweep);

  Turn turn_;
  int family_;
  RowHeights heights_;
  double bottom_ = 0.0, per_height_ = 0.0;
  /// Rows are placed for the whole disk.
  bool whole_disk_ = false;
  /// All rows, sixteen by sixteen.
  std::vector<Scanlines> lines_;
};

}  // namespace penumbra::detail
