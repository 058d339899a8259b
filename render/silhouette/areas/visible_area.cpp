#include "render/silhouette/areas/visible_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/light/arc_sine.h"

namespace penumbra::detail {
namespace {

// Accuracy. Held by the tests VisibleArea, and as a whole by SilhouetteProperty.
/// Depth complexities either way of that of D's lowest point; what is beyond counts as the last.
constexpr int kMostComplexity = 256;
/// A shorter interval is rounding, not a depth complexity. Light radii.
constexpr double kLeastLength = 1e-10;
/// The least room beside a chain for a ray. Light radii.
constexpr double kLeastRoom = 1e-3;
/// The largest correction by the integral, over |D|, up to which rows count as representative.
constexpr double kMostCorrection = 0.02;
/// The most that a few rows may differ from the integral, over |D|.
constexpr double kMostApart = 0.004;

// Speed. Seen in the benchmark `silhouette`.
/// The most rows, where rows were not representative.
constexpr int kMostRows = 1024;
/// The rows that tell whether there are two depth complexities.
constexpr int kFewRows = 16;
/// So many segments have the full number of rows; fewer err as little with three quarters of it.
constexpr std::size_t kMany = 256;
/// The most segments for slabs. With more, rows are faster and err by less than .001.
constexpr std::size_t kMostForSlabs = 20;

/// ∫ √(1 - y²) dy from 0 to each height.
PENUMBRA_VECTOR_CLONES
void integrate_rim(const double* heights, std::size_t count, double* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const double y = heights[i] < -1.0 ? -1.0 : heights[i] > 1.0 ? 1.0 : heights[i];
    out[i] = 0.5 * (y * std::sqrt((1.0 - y) * (1.0 + y)) + arc_sine(y));
  }
}

}  // namespace

bool area_by_chain(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                   VisibleAreaResult& out) {
  if (!is_one_chain(clipped, sliver * part.area())) return false;

  // From where to where it runs, so that the lower depth complexity lies on the right.
  const bool in_order = clipped.events[0].change < 0;
  const Event &start = clipped.events[in_order ? 0 : 1], &end = clipped.events[in_order ? 1 : 0];
  const glm::dvec2 way = end.at - start.at, middle = 0.5 * (start.at + end.at);
  const double length = glm::length(way);
  if (length < kLeastRoom) return false;
  const glm::dvec2 right = glm::dvec2(way.y, -way.x) / length;

  // The room on its right.
  double bulge = 0.0;
  for (const Segment& s : clipped.segments) bulge = std::max(bulge, glm::dot(s.a - middle, right));
  for (const Segment& s : clipped.segments) bulge = std::max(bulge, glm::dot(s.b - middle, right));
  const double reach = part.distance_to_boundary(middle, right);
  if (reach - bulge < kLeastRoom) return false;

  // The area on its right, and two points there.
  const double high_or_low = clipped.integral / end.change;
  out.area =
      std::clamp(part.comes_first(start, end) ? -high_or_low : part.area() - high_or_low, 0.0, part.area());
  out.complexities = 2;
  out.aims = {middle + (0.4 * bulge + 0.6 * reach) * right, middle + (0.7 * bulge + 0.3 * reach) * right};
  out.method = AreaMethod::kChain;
  return true;
}

void VisibleArea::begin(int least) {
  areas_.resize(2 * kMostComplexity + 1);
  aims_ = {};
  least_ = least;
  lowest_ = kMostComplexity + 1, highest_ = -kMostComplexity - 1, parity_ = 0;
}

void VisibleArea::add_interval(const Slab& slab, double from, double to, int complexity) {
  const double length = to - from;
  if (!(length > kLeastLength)) return;
  complexity = std::clamp(complexity, least_, kMostComplexity);
  areas_[complexity + kMostComplexity] += length * slab.height;
  highest_ = std::max(highest_, complexity);
  if (complexity > lowest_) return;
  if (complexity < lowest_) {
    lowest_ = complexity;
    aims_ = {};
  }
  Aim& aim = aims_[parity_];
  const double area = length * slab.height, reach = length + slab.height;
  if (area * aim.reach > aim.area * reach) aim = {area, reach, {0.5 * (from + to), slab.y}};
}

/// By x. Slabs hold few crossings.
void VisibleArea::sort_crossings() {
  for (auto c = crossings_.begin(); c != crossings_.end(); ++c) {
    const Crossing moving = *c;
    auto to = c;
    for (; to != crossings_.begin() && moving.x < to[-1].x; --to) *to = to[-1];
    *to = moving;
  }
}

/// The intervals between a slab's crossings.
void VisibleArea::sweep(const Slab& slab) {
  parity_ ^= 1;
  int complexity = slab.first_complexity;
  double from = slab.left;
  for (const Crossing& c : crossings_) {
    const double x = std::min(std::max(c.x, slab.left), slab.right);
    if (x > from) add_interval(slab, from, x, complexity);
    complexity += c.change;
    from = std::max(from, x);
  }
  add_interval(slab, from, slab.right, complexity);
}

VisibleAreaResult VisibleArea::finish() const {
  VisibleAreaResult out;
  out.area = areas_[lowest_ + kMostComplexity];
  out.complexities = 0;
  for (int k = lowest_; k <= highest_; ++k) out.complexities += areas_[k + kMostComplexity] > 0.0 ? 1 : 0;
  out.aims = {aims_[0].at, aims_[1].at};
  if (aims_[0].room() < aims_[1].room()) std::swap(out.aims[0], out.aims[1]);
  if (std::min(aims_[0].area, aims_[1].area) == 0.0) out.aims[1] = out.aims[0];
  out.method = AreaMethod::kSlabs;
  return out;
}

void VisibleArea::add_line(const Segment& s) {
  const bool up = s.b.y > s.a.y;
  const glm::dvec2 &low = up ? s.a : s.b, &high = up ? s.b : s.a;
  lines_.push_back({low.y, high.y, low.x, (high.x - low.x) / (high.y - low.y), up ? -s.jump : s.jump});
}

/// The heights of ends, of crossings, and of the corners of D's boundary, ascending.
void VisibleArea::make_heights(const DiskPart& part, const ClippedSegments& clipped) {
  heights_ = {part.bottom(), part.top()};
  for (const double corner : part.corner_heights()) heights_.push_back(corner);
  for (const Segment& s : clipped.segments) {
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
  rim_.resize(heights_.size());
  integrate_rim(heights_.data(), heights_.size(), rim_.data());
}

void VisibleArea::sweep_slabs(const ClippedSegments& clipped, const DiskPart& part, int least) {
  begin(least);
  std::size_t before = 0;  // the height where the last slab ended
  for (std::size_t i = 1; i < heights_.size(); ++i) {
    const double low = heights_[i - 1], high = heights_[i], height = high - low;
    if (!(height > kLeastLength)) continue;
    const double y = 0.5 * (low + high);
    const auto [left, right] = part.span(y, (rim_[i] - rim_[before]) / height);
    before = i;
    // L at the left end, and the crossings.
    Slab slab{y, height, left, right, 0};
    for (const Event& e : clipped.events)
      if (e.at.y < y && part.on_left(e)) slab.first_complexity -= e.change;
    crossings_.clear();
    for (const Line& line : lines_)
      if (line.low <= y && y < line.high) crossings_.push_back({line.at(y), line.change});
    sort_crossings();
    sweep(slab);
  }
}

void VisibleArea::forget_areas() {
  std::fill(areas_.begin() + lowest_ + kMostComplexity, areas_.begin() + highest_ + kMostComplexity + 1, 0.0);
}

VisibleAreaResult VisibleArea::by_slabs(const ClippedSegments& clipped, const DiskPart& part, double sliver) {
  lines_.clear();
  for (const Segment& s : clipped.segments)
    if (s.a.y != s.b.y) add_line(s);
  make_heights(part, clipped);
  sweep_slabs(clipped, part, -kMostComplexity);

  // As long as the lowest is a sliver, it counts as the next.
  while (lowest_ < highest_ && areas_[lowest_ + kMostComplexity] <= sliver * part.area()) {
    const int next = lowest_ + 1;
    forget_areas();
    sweep_slabs(clipped, part, next);
  }
  VisibleAreaResult out = finish();
  if (least_ > -kMostComplexity) out.aims[1] = out.aims[0];  // the less roomy may be in the sliver
  forget_areas();
  return out;
}

RowSums VisibleArea::sweep_rows(const ClippedSegments& clipped, const DiskPart& part, int rows,
                                double sliver) {
  RowSums sums = rows_.sweep(clipped, part, rows);
  while (sums.complexities > 1 && sums.lowest_length <= sliver * sums.length) {
    sums = rows_.sweep(clipped, part, rows, sums.lowest + 1.0);
    sums.aims[1] = sums.aims[0];  // the shorter interval may be in the sliver
  }
  return sums;
}

/// Where rows and the exact integral of L disagree by much, something lies between rows that they do not
/// represent: then four times as many are swept.
VisibleAreaResult VisibleArea::by_rows(const ClippedSegments& clipped, const DiskPart& part, int rows,
                                       double sliver) {
  const RowSums sums = sweep_rows(clipped, part, rows, sliver);
  if (!(sums.length > 0.0)) return {part.area(), 1, {part.middle(), part.middle()}, AreaMethod::kRows};

  // The share of the lowest, the mean of L, and the control variate's factor.
  const double share = sums.lowest_length / sums.length, mean = sums.first / sums.length;
  const double variance = sums.second / sums.length - mean * mean;
  const double c = sums.complexities > 1 ? share * (sums.lowest - mean) / variance : 0.0;

  // Corrected by the integral, or with more rows.
  const double correction = c * (clipped.integral - part.area() * mean);
  if (std::abs(correction) > kMostCorrection * part.area() && rows <= kMostRows / 4)
    return by_rows(clipped, part, 4 * rows, sliver);
  const double area = part.area() * share + correction;
  return {std::clamp(area, 0.0, part.area()), sums.complexities, sums.aims, AreaMethod::kRows};
}

bool VisibleArea::by_few_rows(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                              VisibleAreaResult& out) {
  // All jumps are of one size.
  const int step = std::abs(clipped.segments.front().jump);
  if (std::ranges::any_of(clipped.segments, [=](const Segment& s) { return std::abs(s.jump) != step; }))
    return false;

  // Two depth complexities, but for slivers.
  const RowSums sums = sweep_rows(clipped, part, kFewRows, sliver);
  if (!(sums.length > 0.0)) return false;
  const double low = sums.lowest, high = low + step;
  const double mean = sums.first / sums.length;
  // (L - low)(L - high) is 0 at both depth complexities, and two steps squared or more elsewhere.
  const double elsewhere = (sums.second - (low + high) * sums.first) / sums.length + low * high;
  if (!(elsewhere <= 2.0 * step * step * sliver)) return false;

  // Rows and integral agree.
  if (std::abs(clipped.integral - part.area() * mean) > kMostApart * step * part.area()) return false;
  const double area = part.area() - (clipped.integral - low * part.area()) / step;
  out = {std::clamp(area, 0.0, part.area()), sums.complexities, sums.aims, AreaMethod::kChain};
  return true;
}

void VisibleArea::compute(const ClippedSegments& clipped, const DiskPart& part, int rows, double sliver,
                          VisibleAreaResult& out) {
  if (area_by_chain(clipped, part, sliver, out)) return;
  const std::size_t segments = clipped.segments.size();
  if (segments <= kMostForSlabs)
    out = by_slabs(clipped, part, sliver);
  else if (!(sliver > 0.0) || !by_few_rows(clipped, part, sliver, out))
    out = by_rows(clipped, part, segments < kMany ? (3 * rows + 3) / 4 : rows, sliver);
}

}  // namespace penumbra::detail
