// Silhouette method, step area: horizontal lines across the disk, sixteen of them swept together.
//
// In: for each line its ends, the depth complexity L at its left end, and the crossings at which L changes.
// Out: sums over the intervals between crossings, weighted by the height that each line stands for: the
// moments of L, the lowest L and the area at it. Slabs (slabs.h) and rows (rows.h) differ in where they place
// lines.
//
// Lines are lanes. Their crossings are sorted and swept without branches, as many lines at a time as the
// processor has lanes (support/int_lanes.h). A crossing is one number, its position with the change of L in
// the last three bits, so that sorting moves both. Positions are multiples of 2^-26 light radii: that is the
// error of the length of an interval.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace penumbra::detail {

/// Lines that are swept together.
inline constexpr int kScanlines = 16;
/// Positions along lines, in whole units of 2^-26 light radii.
inline constexpr double kPositionsPerRadius = 0x1p26;
/// What rounding puts farther out is put there.
inline constexpr double kMostX = 1.5;

/// One number of each line.
template <class Number>
using EachLine = std::array<Number, kScanlines>;

/// One crossing of each line: 8 · position + change + 4.
struct alignas(sizeof(EachLine<std::int32_t>)) CrossingKeys {
  EachLine<std::int32_t> key;
};

/// The position of x.
inline std::int32_t line_position(double x) {
  return static_cast<std::int32_t>(kPositionsPerRadius * std::min(std::max(x, -kMostX), kMostX));
}

/// `change`: -2 to 2.
inline std::int32_t crossing_key(double x, int change) {
  return 8 * line_position(x) + change + 4;
}

/// Right of every line's end, without a change.
inline constexpr std::int32_t kNoCrossing = 8 * static_cast<std::int32_t>(1.75 * kPositionsPerRadius) + 4;

/// Lines before their first crossings.
struct alignas(sizeof(EachLine<std::int32_t>)) Scanlines {
  /// Positions of the ends. An unused line ends where it begins.
  EachLine<std::int32_t> left{}, right{};
  /// L at the left end.
  EachLine<float> complexity{};
  /// Where the line is, and the height that it stands for.
  EachLine<double> y{}, height{};
};

/// A point well within an interval of length a that stands for height b: a b / (a + b) is its room.
struct RoomyPoint {
  double room = 0.0;
  glm::dvec2 at{0.0};
};

/// Sums over lines. Areas are in squared light radii.
struct LineSums {
  static constexpr double kNone = 1e9;

  /// Σ length · height · L^k, k = 0, 1, 2.
  double area = 0.0, first = 0.0, second = 0.0;
  /// The lowest L, and Σ length · height at it.
  double lowest = kNone, lowest_area = 0.0;
  /// Bit L mod 32 is set for each L that was met.
  std::uint32_t met = 0;
  /// At the lowest L, in even and in odd lines.
  std::array<RoomyPoint, 2> aims;

  int complexities() const;
};

/// Sorts the first `count` crossings of each line. Cost O(count log² count).
void sort_crossings(CrossingKeys* keys, int count);
/// The same for one line after the other, for tests.
void sort_crossings_singly(CrossingKeys* keys, int count);

/// Adds lines to the sums. `keys` are sorted, and behind the `count` of them is one of kNoCrossing. L below
/// `least` counts as `least`.
void sweep_lines(const CrossingKeys* keys, int count, const Scanlines& lines, double least, LineSums& sums);
/// The same by code for any processor: the same bits, for tests.
void sweep_lines_plainly(const CrossingKeys* keys, int count, const Scanlines& lines, double least,
                         LineSums& sums);

/// Puts kNoCrossing behind the last crossing of each line, up to one behind that of the longest. `counts`:
/// how many crossings each line has. Returns the most.
int fill_up(const std::int32_t* counts, CrossingKeys* keys);

}  // namespace penumbra::detail
