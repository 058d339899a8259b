#include "render/silhouette/areas/slabs.h"

#include <algorithm>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

// Accuracy.
/// Lower slabs count for nothing. Light radii. Held by the tests Slabs.
constexpr double kLeastHeight = 1e-11;

// Speed.
/// So many segments are looked at for all heights. Seen in the benchmark `silhouette`.
constexpr std::size_t kFewLines = 32;

/// Higher than any point of D.
constexpr double kNowhere = 2.0;

/// A line's numbers, as in Slabs::Lines.
struct Line {
  double low, high, x, slope;
};

/// The heights at which a line crosses others, or kNowhere.
PENUMBRA_VECTOR_CLONES
void find_crossings(const Line& p, const double* low, const double* high, const double* x,
                    const double* slope, std::size_t count, double* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) {
    const double from = p.low > low[i] ? p.low : low[i], to = p.high < high[i] ? p.high : high[i];
    const double at_from = (p.x + p.slope * (from - p.low)) - (x[i] + slope[i] * (from - low[i]));
    const double at_to = (p.x + p.slope * (to - p.low)) - (x[i] + slope[i] * (to - low[i]));
    const bool crosses = (from < to) & (at_from * at_to < 0.0);
    const double at = from + (to - from) * (at_from / (at_from - at_to));
    out[i] = crosses ? at : kNowhere;
  }
}

/// The keys of a line's crossings with some scanlines.
PENUMBRA_VECTOR_CLONES
void cross_lines(const Line& p, int change, const double* y, std::int32_t* __restrict out) {
  for (int l = 0; l < kScanlines; ++l) {
    double x = p.x + p.slope * (y[l] - p.low);
    x = x < -kMostX ? -kMostX : x;
    x = x > kMostX ? kMostX : x;
    const std::int32_t key = 8 * static_cast<std::int32_t>(kPositionsPerRadius * x) + change + 4;
    out[l] = (p.low <= y[l]) & (y[l] < p.high) ? key : kNoCrossing;
  }
}

}  // namespace

void Slabs::Lines::clear() {
  for (auto* numbers : {&low, &high, &x, &slope}) numbers->clear();
  change.clear();
}

void Slabs::Lines::add(const Segment& s) {
  const bool up = s.b.y > s.a.y;
  const glm::dvec2 &from = up ? s.a : s.b, &to = up ? s.b : s.a;
  low.push_back(from.y);
  high.push_back(to.y);
  x.push_back(from.x);
  slope.push_back((to.x - from.x) / (to.y - from.y));
  change.push_back(up ? -s.jump : s.jump);
}

/// Segments that are not level, in the order of their lower ends where they are many.
void Slabs::sort_lines(const ClippedSegments& clipped) {
  lines_.clear();
  sorted_ = clipped.segments.size() > kFewLines;
  if (!sorted_) {
    for (const Segment& s : clipped.segments)
      if (s.a.y != s.b.y) lines_.add(s);
    return;
  }
  order_.clear();
  for (const Segment& s : clipped.segments)
    if (s.a.y != s.b.y) order_.push_back(&s);
  std::stable_sort(order_.begin(), order_.end(), [](const Segment* p, const Segment* q) {
    return std::min(p->a.y, p->b.y) < std::min(q->a.y, q->b.y);
  });
  for (const Segment* s : order_) lines_.add(*s);
}

/// False where heights become more than `most`.
bool Slabs::add_crossings(std::size_t most) {
  crossings_.resize(std::max(crossings_.size(), lines_.size()));
  for (std::size_t i = 0; i + 1 < lines_.size(); ++i) {
    const Line p{lines_.low[i], lines_.high[i], lines_.x[i], lines_.slope[i]};
    std::size_t last = lines_.size();
    if (sorted_)
      last = std::lower_bound(lines_.low.begin() + static_cast<std::ptrdiff_t>(i) + 1, lines_.low.end(),
                              p.high) -
             lines_.low.begin();
    const std::size_t count = last - i - 1;
    find_crossings(p, &lines_.low[i + 1], &lines_.high[i + 1], &lines_.x[i + 1], &lines_.slope[i + 1], count,
                   crossings_.data());
    std::size_t end = heights_.size();
    heights_.resize(end + count);
    for (std::size_t k = 0; k < count; ++k) {  // without a branch that nothing could predict
      heights_[end] = crossings_[k];
      end += crossings_[k] < kNowhere ? 1 : 0;
    }
    heights_.resize(end);
    if (end > most) return false;
  }
  return true;
}

bool Slabs::find(const ClippedSegments& clipped, const DiskPart& part, std::size_t most) {
  sort_lines(clipped);
  heights_ = {part.bottom(), part.top()};
  for (const double corner : part.corner_heights()) heights_.push_back(corner);
  for (const Segment& s : clipped.segments) {
    heights_.push_back(s.a.y);
    heights_.push_back(s.b.y);
  }
  if (heights_.size() > 2 * most || !add_crossings(2 * most)) return false;
  std::sort(heights_.begin(), heights_.end());
  std::size_t count = 1;
  for (const double y : heights_)
    if (y - heights_[count - 1] > kLeastHeight) heights_[count++] = y;
  heights_.resize(count);
  if (count > most + 1) return false;
  rim_.resize(count);
  integrate_rim(heights_, rim_);
  return true;
}

/// The middle lines of slabs from `first` on.
void Slabs::place(std::size_t first, const DiskPart& part, Scanlines& lines) const {
  for (std::size_t l = 0; l < kScanlines; ++l) {
    const std::size_t i = std::min(first + l, heights_.size() - 2);
    const double height = heights_[i + 1] - heights_[i];
    lines.y[l] = 0.5 * (heights_[i] + heights_[i + 1]);
    const auto [left, right] = part.span(lines.y[l], (rim_[i + 1] - rim_[i]) / height);
    lines.left[l] = line_position(left);
    lines.right[l] = first + l == i ? line_position(std::max(left, right)) : lines.left[l];
    lines.height[l] = height;
  }
}

void Slabs::start_complexities(const ClippedSegments& clipped, const DiskPart& part, Scanlines& lines) const {
  lines.complexity.fill(0.0f);
  for (const Event& e : clipped.events) {
    if (!part.on_left(e)) continue;
    for (int l = 0; l < kScanlines; ++l)
      lines.complexity[l] -= e.at.y < lines.y[l] ? static_cast<float>(e.change) : 0.0f;
  }
}

/// The crossings of the scanlines between two heights, in any order. Returns how many at most.
int Slabs::cross(double low, double high, const Scanlines& lines) {
  if (sorted_) {
    for (; next_ < lines_.size() && lines_.low[next_] < high; ++next_) active_.push_back(next_);
    std::erase_if(active_, [&](std::size_t i) { return lines_.high[i] <= low; });
  } else {
    active_.clear();
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_.low[i] < high && low < lines_.high[i]) active_.push_back(i);
  }
  keys_.resize(std::max(keys_.size(), active_.size() + 1));
  for (std::size_t k = 0; k < active_.size(); ++k) {
    const std::size_t i = active_[k];
    cross_lines({lines_.low[i], lines_.high[i], lines_.x[i], lines_.slope[i]}, lines_.change[i],
                lines.y.data(), keys_[k].key.data());
  }
  keys_[active_.size()].key.fill(kNoCrossing);
  return static_cast<int>(active_.size());
}

LineSums Slabs::sweep(const ClippedSegments& clipped, const DiskPart& part, double least) {
  LineSums sums;
  active_.clear();
  next_ = 0;
  const std::size_t slabs = heights_.size() - 1;
  for (std::size_t first = 0; first < slabs; first += kScanlines) {
    Scanlines lines;
    place(first, part, lines);
    start_complexities(clipped, part, lines);
    const int count = cross(heights_[first], heights_[std::min(first + kScanlines, slabs)], lines);
    sort_crossings(keys_.data(), count);
    sweep_lines(keys_.data(), count, lines, least, sums);
  }
  return sums;
}

}  // namespace penumbra::detail
