#include "render/silhouette/areas/clip_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "render/support/float_lanes.h"

namespace penumbra::detail {
namespace {

using glm::dvec2;

double cross(const dvec2& p, const dvec2& q) {
  return p.x * q.y - p.y * q.x;
}

/// An end of a segment on its way through the cuts.
struct End {
  dvec2 at;
  /// Clipped, so now on D's boundary; and there on the chord.
  bool on_boundary = false, on_chord = false;
};

/// Clips a → b to the disk. False where nothing is left.
bool clip_to_disk(End& a, End& b) {
  const bool in_a = glm::dot(a.at, a.at) < 1.0, in_b = glm::dot(b.at, b.at) < 1.0;
  if (in_a && in_b) return true;
  const dvec2 way = b.at - a.at;
  const double length = glm::length(way);
  if (!(length > 0.0)) return false;
  const dvec2 d = way / length;
  // Foot of the center's perpendicular, from the end that is less far away.
  const bool a_nearer = glm::dot(a.at, a.at) <= glm::dot(b.at, b.at);
  const double distance = cross(a_nearer ? a.at : b.at, d);
  const double half = std::sqrt(std::max(0.0, (1.0 - distance) * (1.0 + distance)));
  const dvec2 foot = distance * dvec2(d.y, -d.x);
  if (!in_a && !in_b) {
    if (!(std::abs(distance) < 1.0) || !(glm::dot(a.at, d) < 0.0) || !(glm::dot(b.at, d) > 0.0)) return false;
  }
  if (!in_a) a = {foot - half * d, true, false};
  if (!in_b) b = {foot + half * d, true, false};
  return true;
}

/// Clips what is left to the part above the horizon. False where nothing is left.
bool clip_to_horizon(End& a, End& b, const Chord& horizon) {
  const double ha = height(horizon, a.at), hb = height(horizon, b.at);
  if (ha > 0.0 && hb > 0.0) return true;
  if (!(ha > 0.0) && !(hb > 0.0)) return false;
  const dvec2 at = a.at + (ha / (ha - hb)) * (b.at - a.at);
  (ha > 0.0 ? b : a) = {at, true, true};
  return true;
}

/// Σ jump · a × b, in four sums that do not wait for each other.
double sum_of_crosses(std::span<const Segment> segments) {
  std::array<double, 4> sums{};
  const std::size_t whole = segments.size() / sums.size() * sums.size();
  for (std::size_t i = 0; i < whole; i += sums.size())
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const Segment& s = segments[i + k];
      sums[k] += s.jump * cross(s.a, s.b);
    }
  for (const Segment& s : segments.subspan(whole)) sums[0] += s.jump * cross(s.a, s.b);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// A chain in coordinates along its general direction and across it, in float: areas of folds need not be
/// exact.
class Folds {
 public:
  /// Speed. The most segments. Seen in the benchmark `growth`.
  static constexpr std::size_t kMost = 128;
  Folds(std::span<const Segment> segments, const dvec2& general)
      : blocks_((segments.size() + kFloatLanes - 1) / kFloatLanes) {
    constexpr float kNowhere = 1e30f;
    const dvec2 along = general / glm::length(general), across(-along.y, along.x);
    // For now the ends as they come: along, along, across, across.
    const auto put = [&](std::size_t i, float a, float b, float a_across, float b_across) {
      const std::size_t block = i / kFloatLanes, lane = i % kFloatLanes;
      first_[block][lane] = a, last_[block][lane] = b;
      start_[block][lane] = a_across, slope_[block][lane] = b_across;
    };
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const dvec2 &a = segments[i].a, &b = segments[i].b;
      put(i, static_cast<float>(glm::dot(a, along)), static_cast<float>(glm::dot(b, along)),
          static_cast<float>(glm::dot(a, across)), static_cast<float>(glm::dot(b, across)));
    }
    for (std::size_t i = segments.size(); i < blocks_ * kFloatLanes; ++i) put(i, kNowhere, kNowhere, 0, 0);
    arrange();
  }

  /// A bound of what one segment that goes back adds to the area of other depth complexities. A line across
  /// the general direction meets k segments that go back and k or k + 1 others. Compare it with a line that
  /// meets at most one, somewhere between the first and the last of these: no depth complexity between them
  /// differs by more than k + 1 ≤ 2 k jumps. So the bound is twice the largest distance between the first
  /// and the last, times the width of the segment.
  float area(std::size_t back) const {
    const float low = first_[back / kFloatLanes][back % kFloatLanes];
    const float high = last_[back / kFloatLanes][back % kFloatLanes];
    return 2.0f * (high - low) * height(low, high);
  }

 private:
  void arrange();
  float height(float low, float high) const;

  std::size_t blocks_;
  std::array<Floats, kMost / kFloatLanes> first_, last_, start_, slope_;
};

/// Turns ends into where segments begin and how they rise along the general direction.
PENUMBRA_VECTOR_CLONES
void Folds::arrange() {
  constexpr float kLeastWidth = 1e-6f;
  for (std::size_t i = 0; i < blocks_; ++i) {
    const Floats a = first_[i], b = last_[i], a_across = start_[i], b_across = slope_[i];
    const Ints turned = b < a;
    const Floats length = magnitude(b - a), width = length > kLeastWidth ? length : kLeastWidth + Floats{};
    first_[i] = turned ? b : a;
    last_[i] = first_[i] + width;
    start_[i] = turned ? b_across : a_across;
    slope_[i] = (turned ? a_across - b_across : b_across - a_across) / width;
  }
}

/// The distance between the lowest and the highest point of the chain over a range along the general
/// direction.
PENUMBRA_VECTOR_CLONES
float Folds::height(float low, float high) const {
  Floats least = 1e30f - Floats{}, most = -1e30f + Floats{};
  for (std::size_t i = 0; i < blocks_; ++i) {
    const Floats from = first_[i] < low ? low + Floats{} : first_[i];
    const Floats to = last_[i] > high ? high + Floats{} : last_[i];
    const Floats at_from = start_[i] + slope_[i] * (from - first_[i]);
    const Floats at_to = start_[i] + slope_[i] * (to - first_[i]);
    const Ints rises = at_to > at_from, met = from <= to;
    const Floats lower = rises ? at_from : at_to, higher = rises ? at_to : at_from;
    least = (met & (lower < least)) ? lower : least;
    most = (met & (higher > most)) ? higher : most;
  }
  float lowest = least[0], highest = most[0];
  for (int lane = 1; lane < kFloatLanes; ++lane) {
    lowest = std::min(lowest, least[lane]);
    highest = std::max(highest, most[lane]);
  }
  return highest - lowest;
}

/// The sum over segments that go back; it ends where it is more than `most`.
template <class GoesBack>
double area_of_folds(std::span<const Segment> segments, const dvec2& general, double most,
                     const GoesBack& goes_back) {
  const Folds folds(segments, general);
  double area = 0.0;
  for (std::size_t i = 0; i < segments.size() && area <= most; ++i)
    if (goes_back(segments[i])) area += folds.area(i);
  return area;
}

}  // namespace

void clip_segments(std::span<const Segment> segments, std::size_t inside, const DiskPart& part,
                   ClippedSegments& out) {
  // Segments inside need no clipping.
  out.segments.assign(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(inside));
  out.events.clear();
  double sum = 0.0;
  int changes = 0;
  const auto cross_boundary = [&](const End& end, int change) {
    if (!end.on_boundary) return;
    Event& event = out.events.emplace_back();  // in place: a copy would wait for what is being written
    event.at.x = end.at.x;
    event.at.y = end.at.y;
    event.on_chord = end.on_chord;
    event.change = change;
    changes += change;
  };
  sum += 0.5 * sum_of_crosses(out.segments);

  // Clip the others.
  for (const Segment& s : segments.subspan(inside)) {
    End a{s.a}, b{s.b};
    if (!clip_to_disk(a, b)) continue;
    if (part.is_cut() && !clip_to_horizon(a, b, part.horizon())) continue;
    cross_boundary(a, -s.jump);
    cross_boundary(b, s.jump);
    sum += 0.5 * s.jump * cross(a.at, b.at);
    Segment& left = out.segments.emplace_back();  // in place, too
    left.a.x = a.at.x;
    left.a.y = a.at.y;
    left.b.x = b.at.x;
    left.b.y = b.at.y;
    left.jump = s.jump;
  }
  out.integral = sum - part.sum_walked(out.events);
  out.closed = changes == 0;
}

bool is_one_chain(const ClippedSegments& clipped, double folds) {
  // One entry and one exit, all jumps of one size; the general direction.
  if (clipped.events.size() != 2) return false;
  dvec2 general(0.0);
  const int size = std::abs(clipped.segments.empty() ? 0 : clipped.segments.front().jump);
  for (const Segment& s : clipped.segments) {
    if (std::abs(s.jump) != size) return false;
    general += s.jump > 0 ? s.b - s.a : s.a - s.b;
  }

  // No segment goes back, or those that do take up little.
  const auto goes_back = [&](const Segment& s) { return glm::dot(s.b - s.a, general) * s.jump < 0.0; };
  if (std::ranges::none_of(clipped.segments, goes_back)) return true;
  return folds > 0.0 && clipped.segments.size() <= Folds::kMost &&
         area_of_folds(clipped.segments, general, folds, goes_back) <= folds;
}

}  // namespace penumbra::detail
