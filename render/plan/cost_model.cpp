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

/// Over the parts of the receivers, of a number of a part.
template <class Number>
double mean(const SampledFacts& sampled, const Number& number) {
  double sum = 0.0;
  for (const SampledPart* part : {&sampled.lit, &sampled.penumbra, &sampled.hidden})
    sum += part->share * number(*part);
  return sum;
}

double nanoseconds_of_ray(const CasterTotals& casters, const SampledPart& part) {
  return fit::kRay + fit::kRayLogFaces * std::log2(1.0 + casters.faces) +
         fit::kRayRootOfBoxes * std::sqrt(part.boxes) + fit::kRayRootOfEdges * std::sqrt(part.edges);
}

double edges_of(const SampledPart& part) {
  return part.edges;
}
double merged_edges_of(const SampledPart& part) {
  return part.merged_edges;
}
double root_of_edges_of(const SampledPart& part) {
  return std::sqrt(part.edges);
}
double edge_length_of(const SampledPart& part) {
  return part.edge_length;
}
double boxes_of(const SampledPart& part) {
  return part.boxes;
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
  const double edges = totals_of_reaching(facts).edges;
  const SampledFacts& s = facts.sampled;
  return in_milliseconds(
      reached(facts) *
              (fit::kSilhouetteReceiver + fit::kSilhouetteMerged * mean(s, merged_edges_of) +
               fit::kSilhouetteRootOfEdges * mean(s, root_of_edges_of) +
               fit::kSilhouetteLength * mean(s, edge_length_of) + fit::kSilhouetteBox * mean(s, boxes_of)) +
          fit::kSilhouetteBandEdge * edges,
      fit::kHierarchyEdge * edges);
}

Cost cost_of_rays(const LightFacts& facts, int samples) {
  const CasterTotals casters = totals_of_reaching(facts);
  const SampledFacts& s = facts.sampled;
  // Those that certificates leave open: a part of the penumbra, and of other receivers before which edges lie.
  const auto open = [&](const SampledPart& part, double edges) {
    return part.share * edges * samples * nanoseconds_of_ray(casters, part);
  };
  const double rest = open(s.hidden, std::min(1.0, s.hidden.edges)) + open(s.lit, std::min(1.0, s.lit.edges));
  return in_milliseconds(
      reached(facts) * (fit::kRaysReceiver + fit::kRaysRootOfEdges * mean(s, root_of_edges_of) +
                        fit::kRaysEdge * mean(s, edges_of) + fit::kRaysBox * mean(s, boxes_of) +
                        fit::kRaysOpenPenumbra * open(s.penumbra, 1.0) + fit::kRaysOpenRest * rest) +
          fit::kRaysBandEdge * casters.edges,
      fit::kHierarchyEdge * casters.edges);
}

Cost cost_of_reference(const LightFacts& facts, int samples) {
  const CasterTotals casters = totals_of_reaching(facts);
  const double ray =
      mean(facts.sampled, [&](const SampledPart& p) { return nanoseconds_of_ray(casters, p); });
  return in_milliseconds(reached(facts) * samples * ray, 0.0);
}

double error_of_silhouette(const LightFacts& facts) {
  // Up to 20 edges across the light are integrated exactly, more by rows. Set by hand, not fitted: by rays in double closed
  // casters of data/scenes are off by .0006 at most and most by less than .0004, foliage and trees by .0009 (docs/accuracy.md).
  constexpr double kFew = 20.0, kOfFew = 0.0004, kOfMany = 0.001;
  return facts.sampled.penumbra.edges > kFew ? kOfMany : kOfFew;
}

double error_of_rays(const LightFacts& facts, int samples) {
  const double n = samples;
  const double by_chance = facts.sampled.variance / n,
               by_strata = facts.sampled.boundary / (n * std::sqrt(n));
  return by_chance + by_strata > 0.0 ? std::sqrt(by_chance * by_strata / (by_chance + by_strata)) : 0.0;
}

int rays_for(const LightFacts& facts, double error) {
  constexpr int kLeast = 2, kMost = 256;  // a side
  for (int side = kLeast; side < kMost; ++side)
    if (error_of_rays(facts, side * side) <= error) return side * side;
  return kMost * kMost;
}

}  // namespace penumbra::detail
