#include "render/silhouette_fuse.h"

#include <algorithm>
#include <cmath>

namespace penumbra::detail {
namespace {

constexpr int kMostLevels = 256;      // either way from the lowest point's; deeper ones count as the last
constexpr double kLeastShare = 1e-9;  // of D: less is rounding, not a level

}  // namespace

/// Counting sort of all crossings by row. A row at height y is crossed by segments with low ≤ y < high; an
/// event on the left side at height e changes the left ends of rows with y ≥ e. With both decided by the same
/// rounding of the same heights, levels stay whole.
void Scanlines::cross_rows(const Cut& cut, const DiskPart& part, int rows) {
  const double bottom = part.bottom(), spacing = (part.top() - bottom) / rows, per = 1.0 / spacing;
  const auto first_at = [&](double y) {
    return std::clamp(static_cast<int>(std::ceil((y - bottom) * per - 0.5)), 0, rows);
  };
  starts_.assign(static_cast<std::size_t>(rows) + 1, 0);
  left_levels_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const Event& e : cut.events)
    if (part.on_left(e)) left_levels_[first_at(e.at.y)] -= e.change;
  for (int i = 1; i < rows; ++i) left_levels_[i] += left_levels_[i - 1];

  const auto range = [&](const Segment& s) {
    return std::pair(first_at(std::min(s.a.y, s.b.y)), first_at(std::max(s.a.y, s.b.y)));
  };
  for (const Segment& s : cut.segments) {
    const auto [from, to] = range(s);
    for (int i = from; i < to; ++i) ++starts_[i];
  }
  int sum = 0;
  for (int& s : starts_) s = sum += s;  // ends, until the loop below has walked them back to starts
  crossings_.resize(static_cast<std::size_t>(sum));
  for (const Segment& s : cut.segments) {
    const auto [from, to] = range(s);
    if (from == to) continue;
    const double slope = (s.b.x - s.a.x) / (s.b.y - s.a.y);
    const int change = s.b.y > s.a.y ? -s.jump : s.jump;
    for (int i = from; i < to; ++i)
      crossings_[--starts_[i]] = {s.a.x + slope * (bottom + (i + 0.5) * spacing - s.a.y), change};
  }
}

void Scanlines::add_interval(int row, double y, double from, double to, int level) {
  const double length = to - from;
  if (!(length > 0.0)) return;
  level = std::clamp(level, -kMostLevels, kMostLevels);
  lowest_ = std::min(lowest_, level);
  highest_ = std::max(highest_, level);
  Level& l = levels_[level + kMostLevels];
  l.area += length;
  Interval& longest = l.longest[row & 1];
  if (length > longest.length) longest = {length, {0.5 * (from + to), y}};
}

void Scanlines::sweep_row(int row, double y, const DiskPart& part) {
  const double left = part.left(y), right = part.right(y);
  if (!(left < right)) return;
  const auto first = crossings_.begin() + starts_[row], last = crossings_.begin() + starts_[row + 1];
  if (last - first == 2) {
    if (first[1].x < first[0].x) std::swap(first[0], first[1]);
  } else {
    std::sort(first, last, [](const Crossing& p, const Crossing& q) { return p.x < q.x; });
  }
  int level = left_levels_[row];
  double from = left;
  for (auto c = first; c != last; ++c) {
    const double x = std::clamp(c->x, left, right);
    add_interval(row, y, from, x, level);
    level += c->change;
    from = x;
  }
  add_interval(row, y, from, right, level);
}

Fused Scanlines::fuse(const Cut& cut, const DiskPart& part, int rows) {
  cross_rows(cut, part, rows);
  levels_.resize(2 * kMostLevels + 1);
  const double spacing = (part.top() - part.bottom()) / rows;
  lowest_ = kMostLevels, highest_ = -kMostLevels;
  for (int i = 0; i < rows; ++i) sweep_row(i, part.bottom() + (i + 0.5) * spacing, part);

  double total = 0.0, mean = 0.0, square = 0.0;
  for (int k = lowest_; k <= highest_; ++k) total += levels_[k + kMostLevels].area;
  Fused out;
  out.levels = 0;
  int lowest = highest_;
  for (int k = highest_; k >= lowest_; --k) {
    const double share = levels_[k + kMostLevels].area / total;
    mean += share * k;
    square += share * k * k;
    if (share < kLeastShare) continue;
    lowest = k;
    ++out.levels;
  }
  const Level& least = levels_[lowest + kMostLevels];
  const double share = least.area / total, variance = square - mean * mean;
  const double c = out.levels > 1 && variance > 0.0 ? share * (lowest - mean) / variance : 0.0;
  out.area = std::clamp(part.area() * share + c * (cut.integral - part.area() * mean), 0.0, part.area());
  out.aims = {least.longest[0].middle, least.longest[1].middle};
  if (!(least.longest[0].length > 0.0)) out.aims[0] = out.aims[1];
  if (!(least.longest[1].length > 0.0)) out.aims[1] = out.aims[0];
  std::fill(levels_.begin() + lowest_ + kMostLevels, levels_.begin() + highest_ + kMostLevels + 1, Level{});
  return out;
}

}  // namespace penumbra::detail
