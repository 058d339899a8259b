#include "render/silhouette_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "render/vector_clones.h"

namespace penumbra::detail {
namespace {

constexpr int kLanes = kRowLanes;
constexpr int kFewKeys = 96;            // a row: what sorts them is written down
constexpr double kLeastLength = 1e-10;  // an interval shorter than that is rounding, not a level
constexpr double kNoLevel = 1e9;        // above all
constexpr double kMagic = 0x1.8p52;     // kMagic + n has the integer n in its last bits

/// x and a change of -2 to 2 in one number; x loses its last three bits.
double crossing_key(double x, int change) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) & ~std::uint64_t{7}) |
                               static_cast<std::uint64_t>(change + 4));
}
/// A key right of every row's end, with change 0.
const double kNoCrossing = crossing_key(4.0, 0);

PENUMBRA_INLINE void order(Reals& before, Reals& after) {
  const Reals p = before, q = after;
  before = p < q ? p : q;
  after = p < q ? q : p;
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

PENUMBRA_VECTOR_CLONES
void sort_few(RowKeys* keys, const std::array<std::uint8_t, 2>* exchanges, std::size_t count) {
  for (std::size_t e = 0; e < count; ++e) order(keys[exchanges[e][0]].x, keys[exchanges[e][1]].x);
}

PENUMBRA_VECTOR_CLONES
void sort_many(RowKeys* keys, int count) {
  for_each_exchange(count, [keys](int i, int j) { order(keys[i].x, keys[j].x); });
}

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

/// The intervals that end at the next keys of some rows.
PENUMBRA_INLINE void sweep_step(const Reals& key, RowLanes& r) {
  const Reals zero{}, none = zero + kNoLevel;
  const Reals right_of_left = key > r.left ? key : r.left;
  const Reals x = right_of_left < r.right ? right_of_left : r.right;
  const Reals ahead = x - r.from, length = ahead > kLeastLength ? ahead : zero;
  r.length += length;
  r.first += r.level * length;
  r.second += r.level * r.level * length;

  const Reals met = length > 0.0 ? r.level : none;
  const Reals sum = met < r.lowest ? zero : r.lowest_length, best = met < r.lowest ? zero : r.best;
  r.lowest = met < r.lowest ? met : r.lowest;
  const Reals at_lowest = met == r.lowest ? length : zero;
  r.lowest_length = sum + at_lowest;
  r.middle = at_lowest > best ? 0.5 * (r.from + x) : r.middle;
  r.best = at_lowest > best ? at_lowest : best;
  const Integers one = Integers{} + 1, bit = one << (__builtin_bit_cast(Integers, r.level + kMagic) & 63);
  r.seen |= length > 0.0 ? bit : Integers{};

  r.from = x > r.from ? x : r.from;
  const Integers code = (__builtin_bit_cast(Integers, key) & 7) | std::bit_cast<std::int64_t>(0x1p52);
  r.level += __builtin_bit_cast(Reals, code) - (0x1p52 + 4.0);
}

/// Puts kNoCrossing behind the ends of some rows, up to one behind the longest; returns how long that is.
/// `ends`: where each row's next key would be, in numbers, row `lane` beginning at `begin` + lane.
PENUMBRA_VECTOR_CLONES
int fill_up(const std::size_t* ends, std::size_t begin, RowKeys* keys) {
  Integers counts;
  std::int64_t shortest = std::numeric_limits<std::int64_t>::max(), longest = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    const auto count = static_cast<std::int64_t>((ends[lane] - begin) / kLanes);
    counts[lane] = count;
    shortest = std::min(shortest, count), longest = std::max(longest, count);
  }
  const Reals none = Reals{} + kNoCrossing;
  for (std::int64_t k = shortest; k <= longest; ++k) keys[k].x = k < counts ? keys[k].x : none;
  return static_cast<int>(longest);
}

PENUMBRA_VECTOR_CLONES
void sweep_lanes(const RowKeys* keys, int count, RowLanes& rows) {
  RowLanes r = rows;
  for (int k = 0; k < count; ++k) sweep_step(keys[k].x, r);
  rows = r;
}

}  // namespace

/// The first row above y. The same rounding for segments and events, so that levels stay whole.
inline int Rows::row_above(double y) const {
  return std::clamp(static_cast<int>((y - bottom_) * per_spacing_ + 0.5), 0, rows_);
}

/// Heights and ends of rows; those of the whole disk stay from receiver to receiver.
void Rows::place_rows(const DiskPart& part, int rows) {
  if (whole_disk_ && !part.is_cut() && rows == rows_) return;
  rows_ = rows;
  whole_disk_ = !part.is_cut();
  stride_ = static_cast<std::size_t>((rows + kLanes - 1) / kLanes * kLanes);
  bottom_ = part.bottom();
  spacing_ = (part.top() - bottom_) / rows;
  per_spacing_ = 1.0 / spacing_;
  ends_.assign(stride_, {0.0, 0.0});
  heights_.resize(stride_);
  for (std::size_t i = 0; i < stride_; ++i) heights_[i] = bottom_ + (static_cast<double>(i) + 0.5) * spacing_;
  for (int i = 0; i < rows; ++i) ends_[i] = part.span(heights_[i], DiskPart::half_width(heights_[i]));
}

/// Segments that cross a row: at height y those with low < y ≤ high.
void Rows::find_crossing(const Cut& cut) {
  crossing_.resize(std::max(crossing_.size(), cut.segments.size() + 1));
  std::size_t count = 0;
  for (const Segment& s : cut.segments) {  // most that are short cross no row
    const int from = row_above(s.a.y), to = row_above(s.b.y);
    crossing_[count] = {&s, from, to};
    count += from != to ? 1 : 0;
  }
  crossing_count_ = count;
}

/// The keys of each row, in any order, and kNoCrossing up to one behind the end of the longest row that it is
/// swept with.
void Rows::cross(const Cut& cut) {
  find_crossing(cut);
  most_ = crossing_count_ + 1;
  keys_.resize(std::max(keys_.size(), most_ * stride_ / kLanes));
  next_.resize(stride_);
  for (std::size_t i = 0; i < stride_; ++i) next_[i] = i / kLanes * most_ * kLanes + i % kLanes;
  auto* const keys = reinterpret_cast<double*>(keys_.data());  // vectors may be accessed as their numbers
  for (const CrossingSegment& c : std::span(crossing_).first(crossing_count_)) {
    const Segment& s = *c.segment;
    const bool up = c.to > c.from;
    const glm::dvec2 &low = up ? s.a : s.b, &high = up ? s.b : s.a;
    const double slope = (high.x - low.x) / (high.y - low.y);
    const int change = up ? -s.jump : s.jump;
    for (int i = std::min(c.from, c.to); i < std::max(c.from, c.to); ++i) {
      keys[next_[i]] = crossing_key(low.x + slope * (heights_[i] - low.y), change);
      next_[i] += kLanes;
    }
  }
  longest_.resize(stride_ / kLanes);
  for (std::size_t block = 0; block < longest_.size(); ++block)
    longest_[block] = fill_up(&next_[block * kLanes], block * most_ * kLanes, &keys_[block * most_]);
}

/// Events on the left side of D change the levels at the left ends of all rows above.
void Rows::start_levels(const Cut& cut, const DiskPart& part) {
  levels_.assign(stride_ + 1, 0);
  for (const Event& e : cut.events)
    if (part.on_left(e)) levels_[row_above(e.at.y)] -= e.change;
  for (int i = 1; i < rows_; ++i) levels_[i] += levels_[i - 1];
}

/// Rows before their first crossing.
void Rows::start(int first, RowLanes& lanes) const {
  lanes = RowLanes{};
  lanes.lowest += kNoLevel;
  for (int l = 0; l < kLanes; ++l) {
    const auto [left, right] = ends_[first + l];
    lanes.left[l] = lanes.from[l] = left;
    lanes.right[l] = std::max(left, right);
    lanes.level[l] = levels_[first + l];
  }
}

void Rows::add(const RowLanes& lanes, int first, Sums& sums) const {
  RowSums& out = sums.sums;
  for (int l = 0; l < std::min(kLanes, rows_ - first); ++l) {
    out.length += lanes.length[l];
    out.first += lanes.first[l];
    out.second += lanes.second[l];
    sums.seen |= static_cast<std::uint64_t>(lanes.seen[l]);
    if (lanes.lowest[l] > out.lowest || lanes.lowest[l] == kNoLevel) continue;
    if (lanes.lowest[l] < out.lowest) out.lowest = lanes.lowest[l], out.lowest_length = 0.0, sums.best = {};
    out.lowest_length += lanes.lowest_length[l];
    if (lanes.best[l] <= sums.best[l % 2]) continue;
    sums.best[l % 2] = lanes.best[l];
    out.aims[l % 2] = {lanes.middle[l], heights_[first + l]};
  }
}

template <class Sweep>
RowSums Rows::sweep_with(const Cut& cut, const DiskPart& part, int rows, const Sweep& sweep_from) {
  place_rows(part, rows);
  cross(cut);
  start_levels(cut, part);
  Sums sums;
  sums.sums.lowest = kNoLevel;
  for (int first = 0; first < static_cast<int>(stride_); first += kLanes) {
    RowLanes lanes;
    start(first, lanes);
    sweep_from(first, lanes);
    add(lanes, first, sums);
  }
  RowSums& out = sums.sums;
  out.levels = std::popcount(sums.seen);
  if (sums.best[0] < sums.best[1]) std::swap(out.aims[0], out.aims[1]);
  if (std::min(sums.best[0], sums.best[1]) == 0.0) out.aims[1] = out.aims[0];
  return out;
}

RowSums Rows::sweep(const Cut& cut, const DiskPart& part, int rows) {
  return sweep_with(cut, part, rows, [&](int first, RowLanes& lanes) {
    const int count = longest_[first / kLanes];
    RowKeys* keys = keys_.data() + static_cast<std::size_t>(first / kLanes) * most_;
    sort_lanes(keys, count);
    sweep_lanes(keys, count + 1, lanes);  // the last key of all ends the last interval
  });
}

RowSums Rows::sweep_singly(const Cut& cut, const DiskPart& part, int rows) {
  return sweep_with(cut, part, rows, [&](int first, RowLanes& lanes) {
    RowKeys* keys = keys_.data() + static_cast<std::size_t>(first / kLanes) * most_;
    const int count = longest_[first / kLanes];
    for (int l = 0; l < kLanes; ++l) sort_row(keys, count, l);  // keys of no crossing stay last
    for (int k = 0; k <= count; ++k) sweep_step(keys[k].x, lanes);
  });
}

}  // namespace penumbra::detail
