#include "render/silhouette_fuse.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace penumbra::detail {
namespace {

constexpr int kMostLevels = 256;        // either way from the lowest point's; deeper ones count as the last
constexpr double kLeastLength = 1e-10;  // an interval shorter than that is rounding, not a level
constexpr double kLeastRoom = 1e-3;     // beside a chain, for a ray
constexpr std::size_t kMostForSlabs = 28;  // segments; beyond, rows are faster and no less exact

/// ∫ √(1 - y²) dy from 0.
double rim_integral(double y) {
  y = std::clamp(y, -1.0, 1.0);
  return 0.5 * (y * std::sqrt((1.0 - y) * (1.0 + y)) + std::asin(y));
}

/// By x; rows hold few crossings, mostly.
template <class Crossing>
void sort_crossings(Crossing* first, Crossing* last) {
  const auto before = [](const Crossing& p, const Crossing& q) { return p.x < q.x; };
  if (last - first > 16) return std::sort(first, last, before);
  for (Crossing* c = first; c != last; ++c) {
    const Crossing moving = *c;
    Crossing* to = c;
    for (; to != first && before(moving, to[-1]); --to) *to = to[-1];
    *to = moving;
  }
}

}  // namespace

bool fuse_chain(const Cut& cut, const DiskPart& part, Fused& out) {
  if (!is_one_chain(cut)) return false;
  // Directed so that the lower level lies on the right.
  const bool in_order = cut.events[0].change < 0;
  const Event &start = cut.events[in_order ? 0 : 1], &end = cut.events[in_order ? 1 : 0];
  const glm::dvec2 way = end.at - start.at, middle = 0.5 * (start.at + end.at);
  const double length = glm::length(way);
  if (length < kLeastRoom) return false;
  const glm::dvec2 right = glm::dvec2(way.y, -way.x) / length;
  double bulge = 0.0;
  for (const Segment& s : cut.segments) bulge = std::max(bulge, glm::dot(s.a - middle, right));
  for (const Segment& s : cut.segments) bulge = std::max(bulge, glm::dot(s.b - middle, right));
  const double reach = part.distance_to_boundary(middle, right);
  if (reach - bulge < kLeastRoom) return false;
  const double high_or_low = cut.integral / end.change;
  out.area =
      std::clamp(part.comes_first(start, end) ? -high_or_low : part.area() - high_or_low, 0.0, part.area());
  out.levels = 2;
  out.aims = {middle + (0.4 * bulge + 0.6 * reach) * right, middle + (0.7 * bulge + 0.3 * reach) * right};
  out.way = Fusion::kChain;
  return true;
}

void Fuser::begin() {
  areas_.resize(2 * kMostLevels + 1);
  aims_ = {};
  lowest_ = kMostLevels + 1, highest_ = -kMostLevels - 1, parity_ = 0;
}

void Fuser::add_interval(const Row& row, double from, double to, int level) {
  const double length = to - from;
  if (!(length > kLeastLength)) return;
  level = std::clamp(level, -kMostLevels, kMostLevels);
  areas_[level + kMostLevels] += length * row.height;
  highest_ = std::max(highest_, level);
  if (level > lowest_) return;
  if (level < lowest_) {
    lowest_ = level;
    aims_ = {};
  }
  const double room = length * row.height / (length + row.height);
  Aim& aim = aims_[parity_];
  if (room > aim.room) aim = {room, {0.5 * (from + to), row.y}};
}

/// The crossings of one row, in any order; they are sorted in place.
void Fuser::sweep(const Row& row, Crossing* first, Crossing* last) {
  parity_ ^= 1;
  sort_crossings(first, last);
  int level = row.first_level;
  double from = row.left;
  for (const Crossing* c = first; c != last; ++c) {
    const double x = std::min(std::max(c->x, row.left), row.right);
    if (x > from) add_interval(row, from, x, level);
    level += c->change;
    from = std::max(from, x);
  }
  add_interval(row, from, row.right, level);
}

Fused Fuser::finish(Fusion way, double area_scale) const {
  Fused out;
  out.area = areas_[lowest_ + kMostLevels] * area_scale;
  out.levels = 0;
  for (int k = lowest_; k <= highest_; ++k) out.levels += areas_[k + kMostLevels] > 0.0 ? 1 : 0;
  out.aims = {aims_[0].at, aims_[1].at};
  if (aims_[0].room < aims_[1].room) std::swap(out.aims[0], out.aims[1]);
  if (std::min(aims_[0].room, aims_[1].room) == 0.0) out.aims[1] = out.aims[0];
  out.way = way;
  return out;
}

void Fuser::add_line(const Segment& s) {
  const bool up = s.b.y > s.a.y;
  const glm::dvec2 &low = up ? s.a : s.b, &high = up ? s.b : s.a;
  lines_.push_back({low.y, high.y, low.x, (high.x - low.x) / (high.y - low.y), up ? -s.jump : s.jump});
}

/// Ends, crossings, and where D's boundary has corners.
void Fuser::make_heights(const DiskPart& part, const Cut& cut) {
  heights_ = {part.bottom(), part.top()};
  for (const double corner : part.corner_heights()) heights_.push_back(corner);
  for (const Segment& s : cut.segments) {
    heights_.push_back(s.a.y);
    heights_.push_back(s.b.y);
  }
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Line &p = lines_[i], &q = lines_[j];
      const double low = std::max(p.low, q.low), high = std::min(p.high, q.high);
      if (!(low < high)) continue;
      const double at_low = p.at(low) - q.at(low), at_high = p.at(high) - q.at(high);
      if (at_low * at_high < 0.0) heights_.push_back(low + (high - low) * (at_low / (at_low - at_high)));
    }
  std::sort(heights_.begin(), heights_.end());
}

Fused Fuser::by_slabs(const Cut& cut, const DiskPart& part) {
  lines_.clear();
  for (const Segment& s : cut.segments)
    if (s.a.y != s.b.y) add_line(s);
  make_heights(part, cut);
  begin();
  double rim_before = rim_integral(heights_.front());
  for (std::size_t i = 1; i < heights_.size(); ++i) {
    const double low = heights_[i - 1], high = heights_[i], height = high - low;
    if (!(height > kLeastLength)) continue;
    const double y = 0.5 * (low + high), rim = rim_integral(high);
    const auto [left, right] = part.span(y, (rim - rim_before) / height);
    rim_before = rim;
    Row row{y, height, left, right, 0};
    for (const Event& e : cut.events)
      if (e.at.y < y && part.on_left(e)) row.first_level -= e.change;
    crossings_.clear();
    for (const Line& line : lines_)
      if (line.low <= y && y < line.high) crossings_.push_back({line.at(y), line.change});
    sweep(row, crossings_.data(), crossings_.data() + crossings_.size());
  }
  const Fused out = finish(Fusion::kSlabs, 1.0);
  std::fill(areas_.begin() + lowest_ + kMostLevels, areas_.begin() + highest_ + kMostLevels + 1, 0.0);
  return out;
}

/// Counting sort of all crossings by row. A row at height y is crossed by segments with low < y ≤ high; an
/// event on the left side at height e changes the left ends of rows with y > e. Both are decided by the same
/// rounding of the same heights, so that levels stay whole.
void Fuser::cross_rows(const Cut& cut, const DiskPart& part, int rows) {
  const double bottom = part.bottom(), spacing = (part.top() - bottom) / rows, per = 1.0 / spacing;
  const auto first_above = [&](double y) {
    return std::clamp(static_cast<int>((y - bottom) * per + 0.5), 0, rows);
  };
  starts_.assign(static_cast<std::size_t>(rows) + 1, 0);
  left_levels_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const Event& e : cut.events)
    if (part.on_left(e)) left_levels_[first_above(e.at.y)] -= e.change;
  for (int i = 1; i < rows; ++i) left_levels_[i] += left_levels_[i - 1];

  lines_.clear();
  spans_.clear();
  for (const Segment& segment : cut.segments) {  // most that are short cross no row
    const int a = first_above(segment.a.y), b = first_above(segment.b.y);
    if (a == b) continue;
    add_line(segment);
    spans_.emplace_back(std::min(a, b), std::max(a, b));
    for (int i = spans_.back().first; i < spans_.back().second; ++i) ++starts_[i];
  }
  int sum = 0;
  for (int& s : starts_) s = sum += s;  // ends, until the loop below has walked them back to starts
  crossings_.resize(static_cast<std::size_t>(sum));
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const Line& line = lines_[k];
    for (int i = spans_[k].first; i < spans_[k].second; ++i)
      crossings_[--starts_[i]] = {line.at(bottom + (i + 0.5) * spacing), line.change};
  }
}

Fused Fuser::by_rows(const Cut& cut, const DiskPart& part, int rows) {
  cross_rows(cut, part, rows);
  begin();
  const double spacing = (part.top() - part.bottom()) / rows;
  for (int i = 0; i < rows; ++i) {
    const double y = part.bottom() + (i + 0.5) * spacing;
    const auto [left, right] = part.span(y, part.half_width(y));
    sweep({y, spacing, left, right, left_levels_[i]}, crossings_.data() + starts_[i],
          crossings_.data() + starts_[i + 1]);
  }
  double total = 0.0, mean = 0.0, square = 0.0;
  for (int k = lowest_; k <= highest_; ++k) {
    const double area = areas_[k + kMostLevels];
    total += area, mean += k * area, square += k * area * k;
  }
  mean /= total;
  const double variance = square / total - mean * mean;
  Fused out = finish(Fusion::kRows, part.area() / total);
  const double c = out.levels > 1 ? out.area / part.area() * (lowest_ - mean) / variance : 0.0;
  out.area = std::clamp(out.area + c * (cut.integral - part.area() * mean), 0.0, part.area());
  std::fill(areas_.begin() + lowest_ + kMostLevels, areas_.begin() + highest_ + kMostLevels + 1, 0.0);
  return out;
}

Fused Fuser::fuse(const Cut& cut, const DiskPart& part, int rows) {
  Fused out;
  if (fuse_chain(cut, part, out)) return out;
  return cut.segments.size() <= kMostForSlabs ? by_slabs(cut, part) : by_rows(cut, part, rows);
}

}  // namespace penumbra::detail
