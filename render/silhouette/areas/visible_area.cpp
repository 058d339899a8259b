#include "render/silhouette/areas/visible_area.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace penumbra::detail {
namespace {

constexpr double kPi = std::numbers::pi;

// Accuracy. Held by the tests VisibleArea and RegularPatterns, and as a whole by SilhouetteProperty.
/// The least room beside a chain for a ray. Light radii.
constexpr double kLeastRoom = 1e-3;
/// A lowest depth complexity of a smaller share of D counts as the next one: it may be a rounding, at which
/// no ray can aim.
constexpr double kLeastShare = 1e-7;
/// The most that the areas of two families may differ, over π: some three times what they do in foliage.
/// Their mean is off by half as much where one of them is.
constexpr double kMostApart = 0.004;
/// The most that a family may be off in the integral of L, over π, in steps of L or its deviations.
constexpr double kMostOff = 0.012;
/// The same where one family is all there is.
constexpr double kMostOffAlone = 0.005;
/// The same where rows meet one depth complexity only: nothing corrects their area then.
constexpr double kMostMissed = 1e-4;
/// One family is enough where it has so many rows for each segment that a line across the rows meets: then no
/// regular pattern lies between them.
constexpr double kRowsToSegments = 2.5;
/// A smaller variance of L is that of one depth complexity.
constexpr double kLeastVariance = 1e-9;
/// What the integral usually corrects of a family's area, over π.
constexpr double kUsualCorrection = 0.003;
/// The most that a few rows may differ from the integral, over |D|.
constexpr double kFewApart = 0.004;

/// How far rows of the second family are turned against the first, radians. Frames of lights are turned
/// themselves (unit_light.h): against their axes rows have slopes of .618 and -4.4.
constexpr double kTurn = 1.24;

// Speed. Seen in the benchmark `silhouette`.
/// How many times as many rows each next pair of families has. Few receivers need more than twice as many.
constexpr std::array<int, kRowLevels> kRefinement{2, 2, 4, 4};
/// The most rows of a family, where usual numbers do not do.
constexpr int kMostRows = 1024;
/// The rows of a family that tell whether there are two depth complexities.
constexpr int kFewRows = 16;
/// The most segments for slabs at once.
constexpr std::size_t kMostForSlabs = 20;

/// What segments are like.
struct Kind {
  /// The smallest |jump|, 1 or 2.
  double step;
  /// How many segments a line from below to above meets on average.
  double met;
};

Kind kind_of(const ClippedSegments& clipped, const DiskPart& part) {
  int odd = 0;
  double extent = 0.0;
  for (const Segment& s : clipped.segments) {
    odd |= s.jump;
    extent += std::abs(s.b.x - s.a.x);
  }
  return {(odd & 1) != 0 ? 1.0 : 2.0, extent * (part.top() - part.bottom()) / part.area()};
}

/// Sums in which the lowest depth complexity is no sliver. `sweep`: makes them, given what lower ones count
/// as.
template <class Sweep>
LineSums sweep_above_slivers(double sliver, const Sweep& sweep) {
  LineSums sums = sweep(-LineSums::kNone);
  while (sums.complexities() > 1 && sums.lowest_area <= std::max(sliver, kLeastShare) * sums.area) {
    sums = sweep(sums.lowest + 1.0);
    // The less roomy point may lie in the sliver.
    auto& aims = sums.aims;
    aims[0] = aims[1] = aims[0].room < aims[1].room ? aims[1] : aims[0];
  }
  return sums;
}

/// The roomier point first; one of them twice where the other has no room.
std::array<glm::dvec2, 2> choose_aims(RoomyPoint one, RoomyPoint other) {
  if (one.room < other.room) std::swap(one, other);
  return {one.at, other.room > 0.0 ? other.at : one.at};
}

/// What one family of rows says.
struct Estimate {
  LineSums sums;
  double area = 0.0;
  /// What the integral of L changed of the area, and how far the family was off in the integral.
  double correction = 0.0, off = 0.0;
  /// Of L.
  double variance = 0.0;
};

Estimate estimate(const LineSums& sums, const ClippedSegments& clipped, const DiskPart& part) {
  Estimate out;
  out.sums = sums;
  const double share = sums.lowest_area / sums.area, mean = sums.first / sums.area;
  out.variance = std::max(0.0, sums.second / sums.area - mean * mean);
  out.off = clipped.integral - part.area() * mean;
  const double covariance = share * (sums.lowest - mean);
  if (out.variance > kLeastVariance) out.correction = covariance / out.variance * out.off;
  out.area = std::clamp(part.area() * share + out.correction, 0.0, part.area());
  return out;
}

/// Whether the rows of a family represent what there is, by the integral of L. `most`: over π, in steps of L
/// or its deviations.
bool agrees_with_integral(const Estimate& e, double step, double most) {
  const double allowed =
      e.variance > kLeastVariance ? most * std::max(step, std::sqrt(e.variance)) : kMostMissed * step;
  return std::abs(e.off) <= allowed * kPi;
}

/// Both families represent what there is, and find the same.
bool agree(const std::array<Estimate, 2>& both, double step) {
  return both[0].sums.lowest == both[1].sums.lowest &&
         std::abs(both[0].area - both[1].area) <= kMostApart * kPi &&
         agrees_with_integral(both[0], step, kMostOff) && agrees_with_integral(both[1], step, kMostOff);
}

VisibleAreaResult result_of(const Estimate& e) {
  VisibleAreaResult out;
  out.area = e.area;
  out.complexities = e.sums.complexities();
  out.aims = choose_aims(e.sums.aims[0], e.sums.aims[1]);
  out.method = AreaMethod::kRows;
  return out;
}

/// The mean of two families, by how much the integral corrected each; or the one that knows of a lower depth
/// complexity.
VisibleAreaResult mean_of(const std::array<Estimate, 2>& both) {
  const LineSums &a = both[0].sums, &b = both[1].sums;
  VisibleAreaResult out = result_of(a.lowest <= b.lowest ? both[0] : both[1]);
  out.complexities = std::popcount(a.met | b.met);
  if (a.lowest != b.lowest) return out;
  const auto weight = [](const Estimate& e) {
    const double usual = kUsualCorrection * kPi;
    return 1.0 / (usual * usual + e.correction * e.correction);
  };
  const double wa = weight(both[0]), wb = weight(both[1]);
  out.area = (wa * both[0].area + wb * both[1].area) / (wa + wb);
  const auto best = [](const LineSums& s) { return s.aims[0].room < s.aims[1].room ? s.aims[1] : s.aims[0]; };
  out.aims = choose_aims(best(a), best(b));
  return out;
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

VisibleArea::VisibleArea()
    : alone_({}, 0),
      families_{Families{alone_, Rows({std::cos(kTurn), std::sin(kTurn)}, 1)}, families_[0], families_[0],
                families_[0]},
      few_(families_[0]) {}

bool VisibleArea::find_and_sweep_slabs(const ClippedSegments& clipped, const DiskPart& part, std::size_t most,
                                       double sliver, VisibleAreaResult& out) {
  if (!slabs_.find(clipped, part, most)) return false;
  const LineSums sums =
      sweep_above_slivers(sliver, [&](double least) { return slabs_.sweep(clipped, part, least); });
  out.area = sums.lowest_area;
  out.complexities = sums.complexities();
  out.aims = choose_aims(sums.aims[0], sums.aims[1]);
  out.method = AreaMethod::kSlabs;
  out.resolved = true;
  return true;
}

VisibleAreaResult VisibleArea::by_slabs(const ClippedSegments& clipped, const DiskPart& part, double sliver) {
  VisibleAreaResult out;
  find_and_sweep_slabs(clipped, part, std::numeric_limits<std::size_t>::max() / 4, sliver, out);
  return out;
}

VisibleAreaResult VisibleArea::by_rows(const ClippedSegments& clipped, const DiskPart& part, int rows,
                                       double sliver) {
  const Kind kind = kind_of(clipped, part);
  const auto sweep = [&](Rows& family) {
    return estimate(
        sweep_above_slivers(sliver,
                            [&](double least) { return family.sweep(clipped, part, rows, memory_, least); }),
        clipped, part);
  };
  if (rows >= kRowsToSegments * kind.met) {
    const Estimate alone = sweep(alone_);
    if (agrees_with_integral(alone, kind.step, kMostOffAlone)) return result_of(alone);
  }
  rows = (3 * rows + 3) / 4;
  VisibleAreaResult out;
  for (std::size_t i = 0; i < families_.size(); ++i) {
    Families& families = families_[i];
    const std::array<Estimate, 2> both{sweep(families[0]), sweep(families[1])};
    out = mean_of(both);
    if (agree(both, kind.step)) return out;
    rows *= kRefinement[i];
    if (find_and_sweep_slabs(clipped, part, 2 * static_cast<std::size_t>(rows), sliver, out)) return out;
    if (rows > kMostRows) break;
  }
  out.resolved = false;
  return out;
}

bool VisibleArea::by_few_rows(const ClippedSegments& clipped, const DiskPart& part, double sliver,
                              VisibleAreaResult& out) {
  // All jumps are of one size.
  const int step = std::abs(clipped.segments.front().jump);
  if (std::ranges::any_of(clipped.segments, [=](const Segment& s) { return std::abs(s.jump) != step; }))
    return false;

  std::array<LineSums, 2> both;
  for (int i = 0; i < 2; ++i) {
    const LineSums sums = sweep_above_slivers(
        sliver, [&](double least) { return few_[i].sweep(clipped, part, kFewRows, memory_, least); });
    // Two depth complexities, but for slivers: (L - low)(L - high) is 0 at both, and two steps squared or
    // more elsewhere.
    const double low = sums.lowest, high = low + step;
    const double mean = sums.first / sums.area;
    const double elsewhere = (sums.second - (low + high) * sums.first) / sums.area + low * high;
    if (!(elsewhere <= 2.0 * step * step * sliver)) return false;
    // Rows and integral agree.
    if (std::abs(clipped.integral - part.area() * mean) > kFewApart * step * part.area()) return false;
    both[i] = sums;
  }
  if (both[0].lowest != both[1].lowest) return false;
  const double area = part.area() - (clipped.integral - both[0].lowest * part.area()) / step;
  out.area = std::clamp(area, 0.0, part.area());
  out.complexities = std::popcount(both[0].met | both[1].met);
  out.aims = choose_aims(both[0].aims[0], both[0].aims[1]);
  out.method = AreaMethod::kChain;
  return true;
}

void VisibleArea::compute(const ClippedSegments& clipped, const DiskPart& part, int rows, double sliver,
                          VisibleAreaResult& out) {
  out.resolved = true;
  if (area_by_chain(clipped, part, sliver, out)) return;
  if (clipped.segments.size() <= kMostForSlabs)
    out = by_slabs(clipped, part, sliver);
  else if (!(sliver > 0.0) || !by_few_rows(clipped, part, sliver, out))
    out = by_rows(clipped, part, rows, sliver);
}

}  // namespace penumbra::detail
