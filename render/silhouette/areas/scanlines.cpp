#include "render/silhouette/areas/scanlines.h"

#include <bit>
#include <vector>

#include "render/support/int_lanes.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// A shorter interval is rounding, not a depth complexity. Positions. Held by the tests VisibleArea.
constexpr std::int32_t kLeastLength = 2;

// Speed.
/// Crossings of a line, below which the exchanges that sort them are written down. Seen in the benchmark
/// `silhouette`.
constexpr int kFewKeys = 96;

/// Lanes of some keys, from lane `first` on, in order.
template <int kLanes>
PENUMBRA_INLINE void order(CrossingKeys& before, CrossingKeys& after, int first) {
  using Lanes = IntLanes<kLanes>;
  const typename Lanes::Integers p = Lanes::load(&before.key[first]), q = Lanes::load(&after.key[first]);
  Lanes::store(p < q ? p : q, &before.key[first]);
  Lanes::store(p < q ? q : p, &after.key[first]);
}

template <int kLanes>
PENUMBRA_INLINE void order_all(CrossingKeys& before, CrossingKeys& after) {
  for (int first = 0; first < kScanlines; first += kLanes) order<kLanes>(before, after, first);
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
PENUMBRA_INLINE void exchange(CrossingKeys* keys, const std::array<std::uint8_t, 2>* pairs,
                              std::size_t count) {
  for (std::size_t e = 0; e < count; ++e) order_all<kLanes>(keys[pairs[e][0]], keys[pairs[e][1]]);
}
PENUMBRA_BY_LANES(void, sort_few,
                  (CrossingKeys * keys, const std::array<std::uint8_t, 2>* pairs, std::size_t count),
                  exchange<kLanes>(keys, pairs, count))

template <int kLanes>
PENUMBRA_INLINE void exchange_all(CrossingKeys* keys, int count) {
  for_each_exchange(count, [keys](int i, int j) { order_all<kLanes>(keys[i], keys[j]); });
}
PENUMBRA_BY_LANES(void, sort_many, (CrossingKeys * keys, int count), exchange_all<kLanes>(keys, count))

/// Some lines behind their last crossings.
struct alignas(sizeof(EachLine<std::int32_t>)) SweptLines {
  /// Σ length · L and Σ length · L², and the lowest L.
  EachLine<float> first, second, lowest;
  /// The length at the lowest L; the length and the middle of the longest interval there.
  EachLine<std::int32_t> lowest_length, best, middle;
  /// As in LineSums.
  EachLine<std::int32_t> met;
};

/// Some lines on their way from left to right.
template <int kLanes>
struct Sweep {
  using Lanes = IntLanes<kLanes>;
  using Integers = typename Lanes::Integers;
  using Numbers = typename Lanes::Numbers;

  Integers left, right, from;  // `from`: where the interval at hand begins
  Numbers complexity, least;   // L of that interval
  Numbers first{}, second{}, lowest{};
  Integers lowest_length{}, best{}, middle{}, met{};  // as in SweptLines

  PENUMBRA_INLINE Sweep(const Scanlines& lines, int lane, float least_complexity)
      : left(Lanes::load(&lines.left[lane])),
        right(Lanes::load(&lines.right[lane])),
        from(left),
        complexity(Lanes::load(&lines.complexity[lane])),
        least(Numbers{} + least_complexity) {
    lowest += static_cast<float>(LineSums::kNone);
  }

  /// The intervals that end at the next crossings.
  PENUMBRA_INLINE void step(const Integers& key) {
    const Integers zero{}, at = key >> 3;
    const Integers right_of_left = at > left ? at : left;
    const Integers x = right_of_left < right ? right_of_left : right;
    const Integers ahead = x - from, length = ahead > kLeastLength ? ahead : zero;
    const Numbers counted = complexity > least ? complexity : least;
    const Numbers weighted = counted * Lanes::numbers(length);
    first += weighted;
    second += counted * weighted;

    const Numbers none = Numbers{} + static_cast<float>(LineSums::kNone);
    const Numbers here = length > 0 ? counted : none;
    const Integers sum = here < lowest ? zero : lowest_length, longest = here < lowest ? zero : best;
    lowest = here < lowest ? here : lowest;
    const Integers at_lowest = here == lowest ? length : zero;
    lowest_length = sum + at_lowest;
    middle = at_lowest > longest ? (from + x) >> 1 : middle;
    best = at_lowest > longest ? at_lowest : longest;
    const Integers bit = (zero + 1) << (Lanes::integers(counted) & 31);
    met |= length > 0 ? bit : zero;

    from = x > from ? x : from;
    complexity += Lanes::numbers((key & 7) - 4);
  }

  PENUMBRA_INLINE void store(SweptLines& out, int lane) const {
    Lanes::store(first, &out.first[lane]);
    Lanes::store(second, &out.second[lane]);
    Lanes::store(lowest, &out.lowest[lane]);
    Lanes::store(lowest_length, &out.lowest_length[lane]);
    Lanes::store(best, &out.best[lane]);
    Lanes::store(middle, &out.middle[lane]);
    Lanes::store(met, &out.met[lane]);
  }
};

template <int kLanes>
PENUMBRA_INLINE void sweep_by(const CrossingKeys* keys, int count, const Scanlines& lines, float least,
                              SweptLines& out) {
  for (int lane = 0; lane < kScanlines; lane += kLanes) {
    Sweep<kLanes> sweep(lines, lane, least);
    for (int k = 0; k < count; ++k) sweep.step(IntLanes<kLanes>::load(&keys[k].key[lane]));
    sweep.store(out, lane);
  }
}
PENUMBRA_BY_LANES(void, sweep_lanes,
                  (const CrossingKeys* keys, int count, const Scanlines& lines, float least, SweptLines& out),
                  sweep_by<kLanes>(keys, count, lines, least, out))

template <int kLanes>
PENUMBRA_INLINE void fill_up_by(const std::int32_t* counts, int shortest, int longest, CrossingKeys* keys) {
  using Lanes = IntLanes<kLanes>;
  const typename Lanes::Integers none = typename Lanes::Integers{} + kNoCrossing;
  for (int lane = 0; lane < kScanlines; lane += kLanes) {
    const typename Lanes::Integers count = Lanes::load(counts + lane);
    for (int k = shortest; k <= longest; ++k) {
      std::int32_t* const at = &keys[k].key[lane];
      Lanes::store(k < count ? Lanes::load(at) : none, at);
    }
  }
}
PENUMBRA_BY_LANES(void, fill_lanes,
                  (const std::int32_t* counts, int shortest, int longest, CrossingKeys* keys),
                  fill_up_by<kLanes>(counts, shortest, longest, keys))

/// The sum over lines, in pairs that do not wait for each other.
template <class Term>
PENUMBRA_INLINE double sum_lines(const Term& term) {
  EachLine<double> terms;
  for (int l = 0; l < kScanlines; ++l) terms[l] = term(l);
  for (int half = kScanlines / 2; half > 0; half /= 2)
    for (int l = 0; l < half; ++l) terms[l] += terms[l + half];
  return terms[0];
}

/// Adds what is at the lowest L of some lines.
PENUMBRA_INLINE void add_lowest(const Scanlines& lines, const SweptLines& swept, LineSums& sums) {
  float least = swept.lowest[0];
  for (int l = 1; l < kScanlines; ++l) least = swept.lowest[l] < least ? swept.lowest[l] : least;
  const double lowest = least;
  if (lowest > sums.lowest || lowest == LineSums::kNone) return;
  if (lowest < sums.lowest) sums.lowest = lowest, sums.lowest_area = 0.0, sums.aims = {};
  constexpr double kUnit = 1.0 / kPositionsPerRadius;
  EachLine<double> length, room;
  for (int l = 0; l < kScanlines; ++l) {
    const bool is_lowest = swept.lowest[l] == least;
    const double best = is_lowest ? kUnit * swept.best[l] : 0.0;
    length[l] = is_lowest ? kUnit * swept.lowest_length[l] : 0.0;
    room[l] = best * lines.height[l] / (best + lines.height[l] + 1e-300);
  }
  sums.lowest_area += sum_lines([&](int l) { return lines.height[l] * length[l]; });
  for (int l = 0; l < kScanlines; ++l) {
    RoomyPoint& aim = sums.aims[l % 2];
    if (room[l] > aim.room) aim = {room[l], {kUnit * swept.middle[l], lines.y[l]}};
  }
}

PENUMBRA_VECTOR_CLONES
void add(const Scanlines& lines, const SweptLines& swept, LineSums& sums) {
  constexpr double kUnit = 1.0 / kPositionsPerRadius;
  sums.area += kUnit * sum_lines([&](int l) { return lines.height[l] * (lines.right[l] - lines.left[l]); });
  sums.first += kUnit * sum_lines([&](int l) { return lines.height[l] * swept.first[l]; });
  sums.second += kUnit * sum_lines([&](int l) { return lines.height[l] * swept.second[l]; });
  for (int l = 0; l < kScanlines; ++l) sums.met |= static_cast<std::uint32_t>(swept.met[l]);
  add_lowest(lines, swept, sums);
}

}  // namespace

int LineSums::complexities() const {
  return std::popcount(met);
}

void sort_crossings(CrossingKeys* keys, int count) {
  if (count >= kFewKeys) return sort_many(keys, count);
  const Exchanges& exchanges = exchanges_of(count);
  sort_few(keys, exchanges.data(), exchanges.size());
}

void sort_crossings_singly(CrossingKeys* keys, int count) {
  std::vector<std::int32_t> line(static_cast<std::size_t>(count));
  for (int lane = 0; lane < kScanlines; ++lane) {
    for (std::size_t k = 0; k < line.size(); ++k) line[k] = keys[k].key[lane];
    std::sort(line.begin(), line.end());
    for (std::size_t k = 0; k < line.size(); ++k) keys[k].key[lane] = line[k];
  }
}

void sweep_lines(const CrossingKeys* keys, int count, const Scanlines& lines, double least, LineSums& sums) {
  SweptLines swept;
  sweep_lanes(keys, count + 1, lines, static_cast<float>(least), swept);
  add(lines, swept, sums);
}

void sweep_lines_plainly(const CrossingKeys* keys, int count, const Scanlines& lines, double least,
                         LineSums& sums) {
  SweptLines swept;
  sweep_by<4>(keys, count + 1, lines, static_cast<float>(least), swept);
  add(lines, swept, sums);
}

int fill_up(const std::int32_t* counts, CrossingKeys* keys) {
  const auto [shortest, longest] = std::minmax_element(counts, counts + kScanlines);
  fill_lanes(counts, *shortest, *longest, keys);
  return *longest;
}

}  // namespace penumbra::detail
