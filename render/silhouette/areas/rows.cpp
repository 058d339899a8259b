#include "render/silhouette/areas/rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "render/support/real_lanes.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// A shorter interval is rounding, not a depth complexity. Light radii. Held by the test VisibleArea.
constexpr double kLeastLength = 1e-10;

// Speed.
/// Keys of a row, below which the exchanges that sort them are written down. Seen in the benchmark
/// `silhouette`.
constexpr int kFewKeys = 96;

/// More than any depth complexity.
constexpr double kNoComplexity = 1e9;
/// kMagic + n has the integer n in its last bits.
constexpr double kMagic = 0x1.8p52;

/// x and a change of -2 to 2 in one number; x loses its last three bits.
double crossing_key(double x, int change) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & ~std::uint64_t{7}) |
                               static_cast<std::uint64_t>(change + 4));
}
/// A key right of every row's end, with change 0.
const double kNoCrossing = crossing_key(4.0, 0);

/// Lanes of some keys, from lane `first` on, in order.
template <int kLanes>
PENUMBRA_INLINE void order(RowKeys& before, RowKeys& after, int first) {
  using Lanes = RealLanes<kLanes>;
  const typename Lanes::Reals p = Lanes::load(&before.x[first]), q = Lanes::load(&after.x[first]);
  Lanes::store(p < q ? p : q, &before.x[first]);
  Lanes::store(p < q ? q : p, &after.x[first]);
}

/// Calls visit(i, j) for the pairs of keys that are to be put in order, one after the other, to sort `count`
/// keys whatever they are: K. Batcher's odd-even merge sort ("Sorting networks and their applications",
/// 1968).
template <class Visit>
PENUMBRA_INLINE void for_each_exchange(int count, const Visit& visit) {
  for (int p = 1; p < count; p *= 2)
    for (int k = p; k >= 1; k /= 2)
      for (int j = k % p; j + k < count; j += 2 * k)
        for (int i = j; i < std::min(j + k, count - k); ++i)
          if ((i & -(2 * p)) == ((i + k) & -(2 * p))) visit(i, i + k);
}

using Exchanges = std::vector<std::array<std::uint8_t, 2>>;

/// The pairs for few keys, written down once.
const Exchanges& exchanges_of(int count) {
  static const auto all = [] {
    std::array<Exchanges, kFewKeys> made;
    for (int n = 0; n < kFewKeys; ++n)
      for_each_exchange(n, [&](int i, int j) {
        made[n].push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)});
      });
    return made;
  }();
  return all[count];
}

template <int kLanes>
PENUMBRA_INLINE void order_all(RowKeys& before, RowKeys& after) {
  for (int first = 0; first < kRowLanes; first += kLanes) order<kLanes>(before, after, first);
}

template <int kLanes>
PENUMBRA_INLINE void exchange(RowKeys* keys, const std::array<std::uint8_t, 2>* pairs, std::size_t count) {
  for (std::size_t e = 0; e < count; ++e) order_all<kLanes>(keys[pairs[e][0]], keys[pairs[e][1]]);
}
PENUMBRA_BY_LANES(void, sort_few,
                  (RowKeys * keys, const std::array<std::uint8_t, 2>* pairs, std::size_t count),
                  exchange<kLanes>(keys, pairs, count))

template <int kLanes>
PENUMBRA_INLINE void exchange_all(RowKeys* keys, int count) {
  for_each_exchange(count, [keys](int i, int j) { order_all<kLanes>(keys[i], keys[j]); });
}
PENUMBRA_BY_LANES(void, sort_many, (RowKeys * keys, int count), exchange_all<kLanes>(keys, count))

/// Sorts the first `count` keys of some rows.
void sort_lanes(RowKeys* keys, int count) {
  if (count >= kFewKeys) return sort_many(keys, count);
  const Exchanges& exchanges = exchanges_of(count);
  sort_few(keys, exchanges.data(), exchanges.size());
}

/// The same for one of the rows.
void sort_row(RowKeys* keys, int count, int lane) {
  std::vector<double> row(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = keys[k].x[lane];
  std::sort(row.begin(), row.end());
  for (std::size_t k = 0; k < row.size(); ++k) keys[k].x[lane] = row[k];
}

/// Some rows on their way from left to right.
template <int kLanes>
struct Sweep {
  using Lanes = RealLanes<kLanes>;
  using Reals = typename Lanes::Reals;
  using Integers = typename Lanes::Integers;

  Reals left, right;
  Reals from, complexity;  // where the interval at hand begins, and its L
  double least;
  Reals length{}, first{}, second{}, lowest{}, lowest_length{}, best{}, middle{};  // as in RowResults
  Integers seen{};

  PENUMBRA_INLINE Sweep(const RowStarts& rows, int lane)
      : left(Lanes::load(rows.left + lane)),
        right(Lanes::load(rows.right + lane)),
        from(left),
        complexity(Lanes::load(rows.complexity + lane)),
        least(rows.least) {
    lowest += kNoComplexity;
  }

  /// The intervals that end at the next keys.
  PENUMBRA_INLINE void step(const Reals& key) {
    const Reals zero{}, none = zero + kNoComplexity;
    const Reals right_of_left = key > left ? key : left;
    const Reals x = right_of_left < right ? right_of_left : right;
    const Reals ahead = x - from, long_enough = ahead > kLeastLength ? ahead : zero;
    const Reals counted = complexity > least ? complexity : zero + least;
    length += long_enough;
    first += counted * long_enough;
    second += counted * counted * long_enough;

    const Reals met = long_enough > 0.0 ? counted : none;
    const Reals sum = met < lowest ? zero : lowest_length, longest = met < lowest ? zero : best;
    lowest = met < lowest ? met : lowest;
    const Reals at_lowest = met == lowest ? long_enough : zero;
    lowest_length = sum + at_lowest;
    middle = at_lowest > longest ? 0.5 * (from + x) : middle;
    best = at_lowest > longest ? at_lowest : longest;
    const Integers one = Integers{} + 1, bit = one << (__builtin_bit_cast(Integers, counted + kMagic) & 63);
    seen |= long_enough > 0.0 ? bit : Integers{};

    from = x > from ? x : from;
    const Integers code = (__builtin_bit_cast(Integers, key) & 7) | std::bit_cast<std::int64_t>(0x1p52);
    complexity += __builtin_bit_cast(Reals, code) - (0x1p52 + 4.0);
  }

  PENUMBRA_INLINE void store(RowResults& out, int lane) const {
    Lanes::store(length, &out.length[lane]);
    Lanes::store(first, &out.first[lane]);
    Lanes::store(second, &out.second[lane]);
    Lanes::store(lowest, &out.lowest[lane]);
    Lanes::store(lowest_length, &out.lowest_length[lane]);
    Lanes::store(best, &out.best[lane]);
    Lanes::store(middle, &out.middle[lane]);
    Lanes::store(seen, &out.seen[lane]);
  }
};

template <int kLanes>
PENUMBRA_INLINE void sweep_by(const RowKeys* keys, int count, const RowStarts& rows, RowResults& out) {
  for (int lane = 0; lane < kRowLanes; lane += kLanes) {
    Sweep<kLanes> sweep(rows, lane);
    for (int k = 0; k < count; ++k) sweep.step(RealLanes<kLanes>::load(&keys[k].x[lane]));
    sweep.store(out, lane);
  }
}
PENUMBRA_BY_LANES(void, sweep_lanes, (const RowKeys* keys, int count, const RowStarts& rows, RowResults& out),
                  sweep_by<kLanes>(keys, count, rows, out))

/// Where each of some rows ends, in keys.
struct RowEnds {
  alignas(kRowLanes * sizeof(std::int64_t)) std::array<std::int64_t, kRowLanes> count;
  std::int64_t shortest, longest;
};

/// Puts kNoCrossing behind the ends of some rows, up to one behind the longest.
template <int kLanes>
PENUMBRA_INLINE void fill_up_by(const RowEnds& ends, RowKeys* keys) {
  using Lanes = RealLanes<kLanes>;
  const typename Lanes::Reals none = typename Lanes::Reals{} + kNoCrossing;
  for (int lane = 0; lane < kRowLanes; lane += kLanes) {
    typename Lanes::Integers count;
    std::memcpy(&count, &ends.count[lane], sizeof(count));
    for (std::int64_t k = ends.shortest; k <= ends.longest; ++k) {
      double* const at = &keys[k].x[lane];
      Lanes::store(k < count ? Lanes::load(at) : none, at);
    }
  }
}
PENUMBRA_BY_LANES(void, fill_up, (const RowEnds& ends, RowKeys* keys), fill_up_by<kLanes>(ends, keys))

/// `ends`: where each row's next key would be, in numbers, row `lane` beginning at `begin` + lane.
RowEnds row_ends(const std::size_t* ends, std::size_t begin) {
  RowEnds out{{}, std::numeric_limits<std::int64_t>::max(), 0};
  for (int lane = 0; lane < kRowLanes; ++lane) {
    const auto count = static_cast<std::int64_t>((ends[lane] - begin) / kRowLanes);
    out.count[lane] = count;
    out.shortest = std::min(out.shortest, count), out.longest = std::max(out.longest, count);
  }
  return out;
}

}  // namespace

/// The first row above y. The same rounding for segments and events, so that depth complexities stay whole.
inline int Rows::row_above(double y) const {
  // NOLINTNEXTLINE(bugprone-incorrect-roundings): what is negative is clamped
  return std::clamp(static_cast<int>((y - bottom_) * per_spacing_ + 0.5), 0, rows_);
}

/// Heights and ends of rows; those of the whole disk stay from receiver to receiver.
void Rows::place_rows(const DiskPart& part, int rows) {
  if (whole_disk_ && !part.is_cut() && rows == rows_) return;
  rows_ = rows;
  whole_disk_ = !part.is_cut();
  stride_ = static_cast<std::size_t>(rows + kRowLanes - 1) / kRowLanes * kRowLanes;
  bottom_ = part.bottom();
  spacing_ = (part.top() - bottom_) / rows;
  per_spacing_ = 1.0 / spacing_;
  left_.assign(stride_, 0.0);
  right_.assign(stride_, 0.0);
  heights_.resize(stride_);
  for (std::size_t i = 0; i < stride_; ++i) heights_[i] = bottom_ + (static_cast<double>(i) + 0.5) * spacing_;
  for (int i = 0; i < rows; ++i) {
    const auto [left, right] = part.span(heights_[i], DiskPart::half_width(heights_[i]));
    left_[i] = left, right_[i] = std::max(left, right);
  }
}

/// Segments that cross a row: at height y those with low < y ≤ high.
void Rows::find_crossing(const ClippedSegments& clipped) {
  crossing_.resize(std::max(crossing_.size(), clipped.segments.size() + 1));
  std::size_t count = 0;
  for (const Segment& s : clipped.segments) {  // most that are short cross no row
    const int from = row_above(s.a.y), to = row_above(s.b.y);
    crossing_[count] = {&s, from, to};
    count += from != to ? 1 : 0;
  }
  crossing_count_ = count;
}

/// The keys of each row, in any order, and kNoCrossing up to one behind the end of the longest row that it is
/// swept with.
void Rows::cross(const ClippedSegments& clipped) {
  find_crossing(clipped);
  most_ = crossing_count_ + 1;
  keys_.resize(std::max(keys_.size(), most_ * stride_ / kRowLanes));
  next_.resize(stride_);
  for (std::size_t i = 0; i < stride_; ++i) next_[i] = i / kRowLanes * most_ * kRowLanes + i % kRowLanes;
  auto* const keys = reinterpret_cast<double*>(keys_.data());  // vectors may be accessed as their numbers
  for (const CrossingSegment& c : std::span(crossing_).first(crossing_count_)) {
    const Segment& s = *c.segment;
    const bool up = c.to > c.from;
    const glm::dvec2 &low = up ? s.a : s.b, &high = up ? s.b : s.a;
    const double slope = (high.x - low.x) / (high.y - low.y);
    const int change = up ? -s.jump : s.jump;
    for (int i = std::min(c.from, c.to); i < std::max(c.from, c.to); ++i) {
      keys[next_[i]] = crossing_key(low.x + slope * (heights_[i] - low.y), change);
      next_[i] += kRowLanes;
    }
  }
  longest_.resize(stride_ / kRowLanes);
  for (std::size_t block = 0; block < longest_.size(); ++block) {
    const RowEnds ends = row_ends(&next_[block * kRowLanes], block * most_ * kRowLanes);
    fill_up(ends, &keys_[block * most_]);
    longest_[block] = static_cast<int>(ends.longest);
  }
}

/// Events on the left side of D change the depth complexities at the left ends of all rows above.
void Rows::start_complexities(const ClippedSegments& clipped, const DiskPart& part) {
  complexities_.assign(stride_ + 1, 0);
  for (const Event& e : clipped.events)
    if (part.on_left(e)) complexities_[row_above(e.at.y)] -= e.change;
  for (int i = 1; i < rows_; ++i) complexities_[i] += complexities_[i - 1];
}

RowStarts Rows::starts(int first) const {
  return {&left_[first], &right_[first], &complexities_[first], least_};
}

void Rows::add(const RowResults& rows, int first, Sums& sums) const {
  RowSums& out = sums.sums;
  for (int l = 0; l < std::min(kRowLanes, rows_ - first); ++l) {
    out.length += rows.length[l];
    out.first += rows.first[l];
    out.second += rows.second[l];
    sums.seen |= static_cast<std::uint64_t>(rows.seen[l]);
    if (rows.lowest[l] > out.lowest || rows.lowest[l] == kNoComplexity) continue;
    if (rows.lowest[l] < out.lowest) out.lowest = rows.lowest[l], out.lowest_length = 0.0, sums.best = {};
    out.lowest_length += rows.lowest_length[l];
    if (rows.best[l] <= sums.best[l % 2]) continue;
    sums.best[l % 2] = rows.best[l];
    out.aims[l % 2] = {rows.middle[l], heights_[first + l]};
  }
}

template <class Sweep>
RowSums Rows::sweep_with(const ClippedSegments& clipped, const DiskPart& part, int rows, double least,
                         const Sweep& sweep_from) {
  least_ = least;
  place_rows(part, rows);
  cross(clipped);
  start_complexities(clipped, part);
  Sums sums;
  sums.sums.lowest = kNoComplexity;
  for (int first = 0; first < static_cast<int>(stride_); first += kRowLanes) {
    RowResults results;
    sweep_from(first, results);
    add(results, first, sums);
  }
  RowSums& out = sums.sums;
  out.complexities = std::popcount(sums.seen);
  if (sums.best[0] < sums.best[1]) std::swap(out.aims[0], out.aims[1]);
  if (std::min(sums.best[0], sums.best[1]) == 0.0) out.aims[1] = out.aims[0];
  return out;
}

RowSums Rows::sweep(const ClippedSegments& clipped, const DiskPart& part, int rows, double least) {
  return sweep_with(clipped, part, rows, least, [&](int first, RowResults& out) {
    const int count = longest_[first / kRowLanes];
    RowKeys* keys = keys_.data() + static_cast<std::size_t>(first / kRowLanes) * most_;
    sort_lanes(keys, count);
    sweep_lanes(keys, count + 1, starts(first), out);  // the last key of all ends the last interval
  });
}

RowSums Rows::sweep_singly(const ClippedSegments& clipped, const DiskPart& part, int rows, double least) {
  return sweep_with(clipped, part, rows, least, [&](int first, RowResults& out) {
    RowKeys* keys = keys_.data() + static_cast<std::size_t>(first / kRowLanes) * most_;
    const int count = longest_[first / kRowLanes];
    for (int l = 0; l < kRowLanes; ++l) sort_row(keys, count, l);  // keys of no crossing stay last
    sweep_by<2>(keys, count + 1, starts(first), out);
  });
}

}  // namespace penumbra::detail
