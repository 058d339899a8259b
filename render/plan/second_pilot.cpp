#include "render/plan/second_pilot.h"

#include <algorithm>

#include "render/plan/candidates.h"
#include "render/plan/cost_model.h"

namespace penumbra::detail {
namespace {

constexpr double kLeastMilliseconds = 0.15;  ///< a second pilot may take so long,
constexpr double kOfFrame = 0.01;            ///< or so much of the frame
constexpr double kFarther = 1.5;             ///< times as many rays as the first one
constexpr double kCheaper = 0.5;  ///< of the time of rays: areas are not given up for better numbers
constexpr double kMostReceivers = 128.0, kFewestReceivers = 8.0;

}  // namespace

PilotWish second_pilot(const LightFacts& facts, const PlanRequest& request) {
  const int samples = rays_for(facts, request.max_error);
  if (facts.sampled.pilots.empty() || samples < kFarther * facts.sampled.pilots.front().samples) return {};
  double by_rays = 1e300, by_areas = 1e300;
  for (const Candidate& each : candidates(facts, request)) {
    double& least = each.method == "silhouette" ? by_areas : by_rays;
    if (each.error <= request.max_error) least = std::min(least, each.milliseconds);
  }
  if (by_areas < kCheaper * by_rays) return {};
  const double time = std::max(kLeastMilliseconds, kOfFrame * request.speed * std::min(by_rays, by_areas));
  const double receivers = std::min(kMostReceivers, time / (2.0 * milliseconds_in_penumbra(facts, samples)));
  if (receivers < kFewestReceivers) return {};
  return {samples, static_cast<std::size_t>(receivers)};
}

}  // namespace penumbra::detail
