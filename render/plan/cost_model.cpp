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

double in_penumbra(const LightFacts& facts) {
  return reached(facts) * facts.sampled.penumbra;
}

double nanoseconds_of_ray(const LightFacts& facts) {
  return fit::kRay + fit::kRayLogFaces * std::log2(1.0 + totals_of_reaching(facts).faces) +
         fit::kRayBox * facts.sampled.boxes;
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
  const double edges = totals_of_reaching(facts).edges, penumbra = in_penumbra(facts);
  return in_milliseconds(
      fit::kSilhouetteReceiver * reached(facts) + fit::kSilhouetteBandEdge * edges +
          penumbra * (fit::kSilhouettePenumbra + fit::kSilhouetteEdge * facts.sampled.edges +
                      fit::kSilhouetteMerged * facts.sampled.merged_edges),
      fit::kHierarchyEdge * edges);
}

Cost cost_of_rays(const LightFacts& facts, int samples) {
  const double edges = totals_of_reaching(facts).edges, penumbra = in_penumbra(facts);
  return in_milliseconds(fit::kCertifyReceiver * reached(facts) + fit::kCertifyBandEdge * edges +
                             penumbra * fit::kCertifyEdge * facts.sampled.edges +
                             penumbra * samples * nanoseconds_of_ray(facts),
                         fit::kHierarchyEdge * edges);
}

Cost cost_of_reference(const LightFacts& facts, int samples) {
  const double all = reached(facts) * nanoseconds_of_ray(facts);
  return in_milliseconds(samples * all, 0.0);
}

double error_of_silhouette(const LightFacts& facts) {
  // Up to 20 edges across the light are integrated exactly; more by rows.
  constexpr double kFew = 20.0;
  return facts.sampled.edges > kFew ? fit::kSilhouetteManyEdges : fit::kSilhouetteLeast;
}

double error_of_rays(const LightFacts& facts, int samples) {
  const double n = samples, edges = std::max(1.0, facts.sampled.edges);
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
