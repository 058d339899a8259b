#include "render/plan/sample/ray_error.h"

#include <algorithm>
#include <cmath>

namespace penumbra::detail {
namespace {

/// The variance of receivers' mean squared errors over their squared mean is taken to be at least this: a
/// sample that has missed the few that are far off would say less.
constexpr double kLeastSpread = 2.0 / 3.0;

/// A mean of `degrees` squares of normal numbers.
struct Estimate {
  double mean = 0.0, degrees = 1.0;
};

/// How many edges make a receiver one that rays are traced for.
struct Limit {
  int areas_up_to;
  double edges_a_sample;
  double chance_of(const RayPilot::Receiver& receiver) const {
    return areas_up_to > 0 ? chance_of_more(receiver.edges, areas_up_to, edges_a_sample) : 1.0;
  }
};

/// Sums over a pilot's receivers, group by group, and over those that were imagined before.
class Sums {
 public:
  void add(double w, double x) {
    weight_ += w;
    error_ += x;
    single2_ += w * w;
    group_weight_ += w;
    group_error_ += x;
  }
  void end_group() {
    weight2_ += group_weight_ * group_weight_;
    error2_ += group_error_ * group_error_;
    both_ += group_weight_ * group_error_;
    group_weight_ = group_error_ = 0.0;
  }
  void add_group(double w, double x) {
    add(w, x);
    end_group();
  }

  Estimate estimate() const {
    const double ratio = error_ / weight_, ratio2 = ratio * ratio;
    const double seen = error2_ - 2.0 * ratio * both_ + ratio2 * weight2_;
    const double least = ratio2 * (2.0 * single2_ + 3.0 * kLeastSpread * weight2_);
    return {ratio, 2.0 * error_ * error_ / std::max({seen, least, 1e-300})};
  }

 private:
  double weight_ = 0.0, error_ = 0.0, single2_ = 0.0;
  /// Of groups.
  double weight2_ = 0.0, error2_ = 0.0, both_ = 0.0;
  double group_weight_ = 0.0, group_error_ = 0.0;
};

/// Receivers of whose squared errors the mean is `each`, and the mean square that of squares of normal
/// numbers: 3 each².
void imagine(Sums& sums, double each) {
  static_assert(kUsualWeight == 3.0);
  for (const double part : {0.0, 0.0, 3.0}) sums.add_group(1.0, part * each);
}

/// `share(receiver)`: of its error.
template <class Share>
void add_all(const RayPilot& pilot, Sums& sums, const Share& share) {
  for (std::size_t i = 0; i < pilot.each.size(); ++i) {
    const RayPilot::Receiver& r = pilot.each[i];
    sums.add(r.weight, r.weight * r.error2 * share(r));
    if (i + 1 == pilot.each.size() || pilot.each[i + 1].group != r.group) sums.end_group();
  }
}

Estimate estimate_of(const RayPilot& pilot, const Limit& limit) {
  Sums all;
  imagine(all, squared_error(pilot.samples, kUsualVariance, kUsualBoundary));
  add_all(pilot, all, [](const auto&) { return 1.0; });
  const Estimate mean = all.estimate();
  if (limit.areas_up_to <= 0) return mean;
  // Of those that were imagined one is traced: that none of some dozens is does not say that none of
  // thousands is.
  Sums traced;
  traced.add_group(1.0, mean.mean);
  traced.add_group(kUsualWeight - 1.0, 0.0);
  add_all(pilot, traced, [&](const auto& receiver) { return limit.chance_of(receiver); });
  return traced.estimate();
}

/// By how much the true mean of a number of squares of normal numbers exceeds the one that was seen, at most
/// in nineteen of twenty cases: degrees over the twentieth part of chi-squared (Wilson and Hilferty, The
/// distribution of chi-square, 1931).
double margin(double degrees) {
  constexpr double kTwentieth = 1.645, kLeast = kUsualWeight;
  const double part = 2.0 / (9.0 * std::max(degrees, kLeast));
  return std::pow(1.0 - part - kTwentieth * std::sqrt(part), -3.0);
}

}  // namespace

double squared_error(double samples, double variance, double boundary) {
  return 1.0 / (samples / variance + samples * std::sqrt(samples) / boundary);
}

double chance_of_more(double edges, double most, double edges_a_sample) {
  // Of N edges each was looked at with the probability p = 1 / edges_a_sample: the number seen has the
  // variance N p (1 - p).
  const double deviation = std::sqrt((edges + edges_a_sample) * std::max(0.0, edges_a_sample - 1.0));
  if (!(deviation > 0.0)) return edges > most ? 1.0 : 0.0;
  return 0.5 * std::erfc((most + 0.5 - edges) / (std::sqrt(2.0) * deviation));
}

double squared_error_kept(const SampledFacts& facts, int samples, int areas_up_to) {
  const double by_model = squared_error(samples, facts.variance, facts.boundary);
  if (facts.pilots.empty()) return by_model;
  // A longer list of edges is not even looked at.
  const int most = std::min(areas_up_to, kEdgesOfRay * samples);
  const Limit limit{most, facts.edges_a_sample};
  double weights = 0.0, sum = 0.0;
  for (const RayPilot& pilot : facts.pilots) {
    const Estimate seen = estimate_of(pilot, limit);
    const double at_pilot = squared_error(pilot.samples, facts.variance, facts.boundary);
    const double away = 0.25 / std::sqrt(3.0) * std::log(samples / static_cast<double>(pilot.samples));
    const double weight = 1.0 / (2.0 / seen.degrees + away * away);
    weights += weight;
    // The logarithm of a mean of ν squares is by 1/ν too low on average.
    sum += weight * (std::log(seen.mean * by_model / at_pilot) + 1.0 / seen.degrees);
  }
  const double degrees = 2.0 * weights;
  return std::exp(sum / weights - 1.0 / degrees) * margin(degrees);
}

}  // namespace penumbra::detail
