#include "render/plan/cost_model.h"

#include <algorithm>
#include <cmath>

#include "render/plan/cost_model_fit.h"

namespace penumbra::detail {
namespace {

constexpr double kMillisecondsPerNanosecond = 1e-6;

double reached(const LightFacts& facts) {
  return static_cast<double>(facts.receivers - facts.dark);
}

double nanoseconds_of_ray(const LightFacts& facts, double boxes) {
  return fit::kRay + fit::kRayLogFaces * std::log2(1.0 + totals_of_reaching(facts).faces) +
         fit::kRayBox * boxes;
}

/// Receivers that certificates leave open: the penumbra, and others before which edges lie.
double open(const LightFacts& facts) {
  const SampledFacts& s = facts.sampled;
  return reached(facts) * (s.penumbra.share + s.hidden.share * std::min(1.0, s.hidden.edges) +
                           s.lit.share * std::min(1.0, s.lit.edges));
}

Cost in_milliseconds(double frame, double setup) {
  return {frame * kMillisecondsPerNanosecond, setup * kMillisecondsPerNanosecond};
}

}  // namespace

CasterTotals totals_of_reaching(const LightFacts& facts) {
  CasterTotals out;
  for (const CasterFacts& caster : facts.casters) {
    if (caster.reach != CasterReach::kMayReach) continue;
    out.faces += static_cast<double>(caster.faces);
    out.edges += static_cast<double>(caster.edges);
  }
  return out;
}

Cost cost_of_silhouette(const LightFacts& facts) {
  const double edges = totals_of_reaching(facts).edges, receivers = reached(facts);
  return in_milliseconds(
      receivers * (fit::kSilhouetteReceiver + fit::kSilhouetteEdge * facts.sampled.mean(&SampledPart::edges) +
                   fit::kSilhouetteMerged * facts.sampled.mean(&SampledPart::merged_edges)) +
          fit::kSilhouetteOpen * open(facts) + fit::kSilhouetteBandEdge * edges,
      fit::kHierarchyEdge * edges);
}

Cost cost_of_rays(const LightFacts& facts, int samples) {
  const double edges = totals_of_reaching(facts).edges, receivers = reached(facts);
  return in_milliseconds(
      receivers * (fit::kCertifyReceiver + fit::kCertifyEdge * facts.sampled.mean(&SampledPart::edges)) +
          fit::kCertifyBandEdge * edges +
          open(facts) * samples * nanoseconds_of_ray(facts, facts.sampled.penumbra.boxes),
      fit::kHierarchyEdge * edges);
}

Cost cost_of_reference(const LightFacts& facts, int samples) {
  return in_milliseconds(
      reached(facts) * samples * nanoseconds_of_ray(facts, facts.sampled.mean(&SampledPart::boxes)), 0.0);
}

double error_of_silhouette(const LightFacts& facts) {
  // Up to 20 edges across the light are integrated exactly; more by rows.
  constexpr double kFew = 20.0;
  return facts.sampled.penumbra.edges > kFew ? fit::kSilhouetteManyEdges : fit::kSilhouetteLeast;
}

double error_of_rays(const LightFacts& facts, int samples) {
  const double n = samples, edges = std::max(1.0, facts.sampled.penumbra.edges);
  const double by_chance = facts.sampled.variance / n;
  const double by_strata = fit::kStrata * std::pow(edges, fit::kStrataPower) / (n * std::sqrt(n));
  return by_chance + by_strata > 0.0 ? std::sqrt(by_chance * by_strata / (by_chance + by_strata)) : 0.0;
}

int rays_for(const LightFacts& facts, double error) {
  constexpr int kLeast = 2, kMost = 256;  // a side
  for (int side = kLeast; side < kMost; ++side)
    if (error_of_rays(facts, side * side) <= error) return side * side;
  return kMost * kMost;
}

}  // namespace penumbra::detail
