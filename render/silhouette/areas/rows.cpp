#include "render/silhouette/areas/rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/support/int_lanes.h"

namespace penumbra::detail {
namespace {

// Memory.
/// So many crossings of sixteen rows are kept at a time, where segments could have them.
constexpr std::size_t kMostKeys = 4096;

/// The rows above heights, given as shares of the height of D.
PENUMBRA_VECTOR_CLONES
void rows_above(const double* shares, std::size_t count, const RowCount& counted, int* __restrict rows) {
  const RowCount f = counted;
  for (std::size_t i = 0; i < count; ++i) rows[i] = f.below(shares[i]);
}

/// From points to shares of the height of D.
struct Heights {
  Turn turn;
  double bottom, per_height;

  PENUMBRA_INLINE double share(double x, double y) const {
    return (turn.sine * x + turn.cosine * y - bottom) * per_height;
  }
};

/// The segments that cross rows first to last. Returns how many. Most that are short cross none.
std::size_t find_crossing(const int* row_a, const int* row_b, std::size_t count, int first, int last,
                          int* __restrict crossing) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    crossing[found] = static_cast<int>(i);
    const int a = row_a[i], b = row_b[i], low = a < b ? a : b, high = a < b ? b : a;
    found += (low < last) & (high > first) & (low < high) ? 1 : 0;
  }
  return found;
}

/// Rows whose keys are written together.
constexpr int kTogether = 8;

/// Segments, how they are turned, the rows above their ends, and where rows are.
struct CrossingRows {
  const Segment* segments;
  Turn turn;
  const int *row_a, *row_b;
  const double* y;
};

/// Where the keys of the rows first to last belong.
struct KeysOfRows {
  int first, last;
  /// The place of the next key of each row.
  std::int32_t* next;
  std::int32_t* keys;
};

/// A segment's keys, eight at a time: few segments need more. Where they belong is read and written in the
/// same pieces of four numbers; the processor waits where it reads again what was written in others. What is
/// written for rows that the segment does not cross is overwritten by the next key of that row: this needs no
/// branch, which nothing could predict.
template <int kLanes>
PENUMBRA_INLINE void write_keys_of(const CrossingRows& r, int i, const KeysOfRows& out) {
  using Lanes = IntLanes<kLanes>;
  using Piece = typename IntLanes<4>::Integers;
  constexpr int kReals = kLanes / 2;
  const typename Lanes::Reals farthest = typename Lanes::Reals{} + kMostX * kPositionsPerRadius;
  const Segment& s = r.segments[i];
  const glm::dvec2 a = r.turn(s.a), b = r.turn(s.b);
  const bool up = r.row_b[i] > r.row_a[i];
  const double x = kPositionsPerRadius * a.x, slope = kPositionsPerRadius * (b.x - a.x) / (b.y - a.y);
  const int low = up ? r.row_a[i] : r.row_b[i], high = up ? r.row_b[i] : r.row_a[i];
  const int from = std::max(low, out.first) - out.first, to = std::min(high, out.last) - out.first;
  const int code = (up ? -s.jump : s.jump) + 4;
  int row = from / 4 * 4;
  do {
    std::array<std::int32_t, kTogether> key;
    for (int l = 0; l < kTogether; l += kReals) {
      typename Lanes::Reals y;
      std::memcpy(&y, r.y + row + l, sizeof(y));
      using Keys = typename Lanes::HalfIntegers;
      typename Lanes::Reals position = x + slope * (y - a.y);  // as line_position, clamped as well
      position = position < farthest ? position : farthest;
      position = position > -farthest ? position : -farthest;
      const Keys keys = 8 * __builtin_convertvector(position, Keys) + code;
      std::memcpy(&key[l], &keys, sizeof(keys));
    }
    for (int l = 0; l < kTogether; ++l) out.keys[out.next[row + l]] = key[l];
    for (int l = 0; l < kTogether; l += 4) {
      const Piece rows = Piece{0, 1, 2, 3} + (row + l);
      Piece next = IntLanes<4>::load(out.next + row + l);
      next += (rows >= from) & (rows < to) & kScanlines;
      IntLanes<4>::store(next, out.next + row + l);
    }
    row += kTogether;
  } while (row < to);
}
template <int kLanes>
PENUMBRA_INLINE void write_all_keys(const CrossingRows& r, const int* crossing, std::size_t count,
                                    const KeysOfRows& out) {
  for (std::size_t k = 0; k < count; ++k) write_keys_of<kLanes>(r, crossing[k], out);
}
PENUMBRA_BY_LANES(void, write_keys,
                  (const CrossingRows& r, const int* crossing, std::size_t count, const KeysOfRows& out),
                  write_all_keys<kLanes>(r, crossing, count, out))

/// D turned.
DiskPart turn_part(const Turn& turn, const DiskPart& part) {
  if (!part.is_cut()) return part;
  return DiskPart({turn(part.horizon().normal), part.horizon().delta});
}

}  // namespace

/// Ends of rows; those of the whole disk stay from receiver to receiver. Where the rim is, is its mean over
/// the strip, so that lengths times heights add up to the area of the disk.
void Rows::place(const DiskPart& turned, int rows, RowMemory& m) {
  const bool same = rows == heights_.rows() && !lines_.empty();
  if (same && whole_disk_ && !turned.is_cut()) return;
  if (!same) heights_ = RowHeights(rows, family_);
  whole_disk_ = !turned.is_cut();
  bottom_ = turned.bottom();
  const double height = turned.top() - bottom_;
  per_height_ = 1.0 / height;
  m.bounds.resize(rows + 1);
  m.rim.resize(rows + 1);
  for (int i = 0; i <= rows; ++i) m.bounds[i] = bottom_ + height * heights_.bound(i);
  integrate_rim(m.bounds, m.rim);

  lines_.assign((rows + kScanlines - 1) / kScanlines, {});
  for (int i = 0; i < rows; ++i) {
    Scanlines& lines = lines_[i / kScanlines];
    const int lane = i % kScanlines;
    lines.y[lane] = bottom_ + height * heights_.row(i);
    lines.height[lane] = m.bounds[i + 1] - m.bounds[i];
    const auto [left, right] =
        turned.span(lines.y[lane], (m.rim[i + 1] - m.rim[i]) / std::max(lines.height[lane], 1e-300));
    lines.left[lane] = line_position(left);
    lines.right[lane] = line_position(std::max(left, right));
  }
}

/// The rows above the ends of segments. Coordinates lie too far apart to be read in vectors.
void Rows::find_rows(const ClippedSegments& clipped, RowMemory& m) const {
  const std::size_t count = clipped.segments.size();
  for (auto* numbers : {&m.row_a, &m.row_b, &m.crossing})
    numbers->resize(std::max(numbers->size(), count + 1));
  m.shares.resize(std::max(m.shares.size(), 2 * count));
  double* const shares = m.shares.data();
  const Heights heights{turn_, bottom_, per_height_};
  for (std::size_t i = 0; i < count; ++i) {
    const Segment& s = clipped.segments[i];
    shares[i] = heights.share(s.a.x, s.a.y);
    shares[count + i] = heights.share(s.b.x, s.b.y);
  }
  rows_above(shares, count, heights_.count(), m.row_a.data());
  rows_above(shares + count, count, heights_.count(), m.row_b.data());
}

/// The keys of the rows first to last, in any order, and how many. A segment crosses rows at height y with
/// low < y ≤ high.
void Rows::cross(const ClippedSegments& clipped, int first, int last, RowMemory& m) const {
  const std::size_t count =
      find_crossing(m.row_a.data(), m.row_b.data(), clipped.segments.size(), first, last, m.crossing.data());
  m.stride = static_cast<int>(count) + 1;
  const int sixteens =
      (last - first + kScanlines - 1) / kScanlines + 1;  // the last is for what lies behind the rows
  m.keys.resize(std::max(m.keys.size(), static_cast<std::size_t>(m.stride * sixteens)));
  for (int i = 0; i < sixteens * kScanlines; ++i) {
    m.next[i] = i / kScanlines * m.stride * kScanlines + i % kScanlines;
    m.y[i] = first + i < last ? lines_[(first + i) / kScanlines].y[i % kScanlines] : 0.0;
  }
  write_keys({clipped.segments.data(), turn_, m.row_a.data(), m.row_b.data(), m.y.data()}, m.crossing.data(),
             count,
             {first, last, m.next.data(),
              reinterpret_cast<std::int32_t*>(m.keys.data())});  // numbers lie one behind the other
  for (int i = 0; i < sixteens * kScanlines; ++i)
    m.counts[i] = (m.next[i] - i % kScanlines) / kScanlines - i / kScanlines * m.stride;
}

/// L at the left ends: that at the lowest point of D as it is turned, and the events on the left side below.
void Rows::start_complexities(const ClippedSegments& clipped, const DiskPart& part, const DiskPart& turned,
                              RowMemory& m) {
  Event lowest = turned.lowest();
  lowest.at = turn_.back(lowest.at);
  int complexity = 0;
  const std::size_t rows = lines_.size() * kScanlines, events = clipped.events.size();
  m.shares.resize(std::max(m.shares.size(), events));
  m.crossing.resize(std::max(m.crossing.size(), events));
  m.changes.assign(rows + 1, 0);
  const Heights heights{turn_, bottom_, per_height_};
  for (std::size_t i = 0; i < events; ++i) {
    const Event& e = clipped.events[i];
    complexity += part.comes_first(e, lowest) ? e.change : 0;
    m.shares[i] = heights.share(e.at.x, e.at.y);
  }
  rows_above(m.shares.data(), events, heights_.count(), m.crossing.data());
  for (std::size_t i = 0; i < events; ++i) {
    const Event& e = clipped.events[i];
    m.changes[m.crossing[i]] -= turned.on_left({turn_(e.at), e.on_chord, e.change}) ? e.change : 0;
  }
  for (std::size_t i = 0; i < rows; ++i) {
    complexity += m.changes[i];
    lines_[i / kScanlines].complexity[i % kScanlines] = static_cast<float>(complexity);
  }
}

template <class Sweep>
LineSums Rows::sweep_with(const ClippedSegments& clipped, const DiskPart& part, int rows, RowMemory& m,
                          const Sweep& sweep) {
  const DiskPart turned = turn_part(turn_, part);
  place(turned, rows, m);
  start_complexities(clipped, part, turned, m);
  find_rows(clipped, m);
  LineSums sums;
  const std::size_t sixteens = std::clamp<std::size_t>(kMostKeys / (clipped.segments.size() + 1), 1, 4);
  const int batch = static_cast<int>(sixteens) * kScanlines;
  for (int first = 0; first < rows; first += batch) {
    const int last = std::min(first + batch, rows);
    cross(clipped, first, last, m);
    for (int i = 0; i * kScanlines < last - first; ++i) {
      CrossingKeys* const keys = &m.keys[static_cast<std::size_t>(i) * m.stride];
      sweep(keys, fill_up(&m.counts[i * kScanlines], keys), lines_[first / kScanlines + i], sums);
    }
  }
  for (RoomyPoint& aim : sums.aims) aim.at = turn_.back(aim.at);
  return sums;
}

LineSums Rows::sweep(const ClippedSegments& clipped, const DiskPart& part, int rows, RowMemory& memory,
                     double least) {
  return sweep_with(clipped, part, rows, memory,
                    [least](CrossingKeys* keys, int count, const Scanlines& lines, LineSums& sums) {
                      sort_crossings(keys, count);
                      sweep_lines(keys, count, lines, least, sums);
                    });
}

LineSums Rows::sweep_singly(const ClippedSegments& clipped, const DiskPart& part, int rows, RowMemory& memory,
                            double least) {
  return sweep_with(clipped, part, rows, memory,
                    [least](CrossingKeys* keys, int count, const Scanlines& lines, LineSums& sums) {
                      sort_crossings_singly(keys, count);
                      sweep_lines_plainly(keys, count, lines, least, sums);
                    });
}

}  // namespace penumbra::detail
