#include "render/plan/cost_model.h"

#include <algorithm>
#include <array>
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
         fit::kRayRootOfBoxes * std::sqrt(part.boxes) + fit::kRayRootOfEdges * std::sqrt(part.edges) +
         fit::kRayRootOfBoth * std::sqrt(part.boxes * part.edges);
}

/// Of a receiver whose area is integrated by the usual number of rows.
double nanoseconds_of_area(const SampledPart& part) {
  return fit::kSilhouetteMerged * part.merged_edges + fit::kSilhouetteRootOfEdges * std::sqrt(part.edges) +
         fit::kSilhouetteLength * part.edge_length;
}

double root_of_edges_of(const SampledPart& part) {
  return std::sqrt(part.edges);
}
double boxes_of(const SampledPart& part) {
  return part.boxes;
}

/// By how much another number of rows changes areas of many edges: its time, and RMSE over the penumbra.
struct Rows {
  int rows;
  double time, error;
};
constexpr std::array<Rows, 3> kRows{{{64, 1.0, fit::kErrorOfMany64},
                                     {32, fit::kTimeOf32Rows, fit::kErrorOfMany32},
                                     {16, fit::kTimeOf16Rows, fit::kErrorOfMany16}}};

const Rows& rows_named(int rows) {
  return *std::ranges::find(kRows, rows, &Rows::rows);
}

// Up to so many edges are integrated exactly, without rows (docs/methods/silhouette.md).
constexpr double kFewEdges = 20.0;
// As RaysMethod: a receiver with more edges in its list is left to rays.
constexpr double kEdgesOfRay = 24.0;

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

std::span<const int> silhouette_rows() {
  static constexpr std::array<int, kRows.size()> rows{kRows[0].rows, kRows[1].rows, kRows[2].rows};
  return rows;
}

Cost cost_of_silhouette(const LightFacts& facts, int rows) {
  const double edges = totals_of_reaching(facts).edges, times = rows_named(rows).time;
  const SampledFacts& s = facts.sampled;
  const double areas = mean(s, [&](const SampledPart& part) {
    return (part.edges > kFewEdges ? times : 1.0) * nanoseconds_of_area(part);
  });
  return in_milliseconds(
      reached(facts) * (fit::kSilhouetteReceiver + areas + fit::kSilhouetteBox * mean(s, boxes_of)) +
          fit::kSilhouetteBandEdge * edges,
      fit::kHierarchyEdge * edges);
}

Cost cost_of_rays(const LightFacts& facts, int samples, int areas_up_to) {
  const CasterTotals casters = totals_of_reaching(facts);
  const SampledFacts& s = facts.sampled;
  // Those that certificates leave open: a part of the penumbra, and of other receivers before which edges lie. Of these some
  // have few edges, and areas.
  const auto open = [&](const SampledPart& part, double share) {
    const double traced = samples * nanoseconds_of_ray(casters, part);
    const double few =
        part.edges > 0.0 ? std::min(1.0, areas_up_to / part.edges) : (areas_up_to > 0 ? 1.0 : 0.0);
    return part.share * share *
           (few * std::min(few * nanoseconds_of_area(part), traced) + (1.0 - few) * traced);
  };
  const double rest = open(s.hidden, std::min(1.0, s.hidden.edges)) + open(s.lit, std::min(1.0, s.lit.edges));
  const double looked_at =
      mean(s, [&](const SampledPart& part) { return std::min(part.edges, kEdgesOfRay * samples); });
  return in_milliseconds(
      reached(facts) * (fit::kRaysReceiver + fit::kRaysRootOfEdges * mean(s, root_of_edges_of) +
                        fit::kRaysEdge * looked_at + fit::kRaysBox * mean(s, boxes_of) +
                        fit::kRaysOpenPenumbra * open(s.penumbra, 1.0) + fit::kRaysOpenRest * rest) +
          fit::kRaysBandEdge * casters.edges,
      fit::kHierarchyEdge * casters.edges);
}

int areas_up_to(const LightFacts& facts, int samples) {
  constexpr double kUsual = 60.0;  // nanoseconds an edge, where no edge was seen
  constexpr double kLeast = 3.0, kMost = 65'536.0;
  const SampledPart& part = facts.sampled.penumbra;
  const double edge = part.edges > 0.0 ? nanoseconds_of_area(part) / part.edges : kUsual;
  const double edges = samples * nanoseconds_of_ray(totals_of_reaching(facts), part) / std::max(edge, 1.0);
  return edges < kLeast ? 0 : static_cast<int>(std::min(edges, kMost));
}

Cost cost_of_reference(const LightFacts& facts, int samples) {
  const CasterTotals casters = totals_of_reaching(facts);
  const double ray =
      mean(facts.sampled, [&](const SampledPart& p) { return nanoseconds_of_ray(casters, p); });
  return in_milliseconds(reached(facts) * samples * ray, 0.0);
}

double error_of_silhouette(const LightFacts& facts, int rows) {
  return facts.sampled.penumbra.edges > kFewEdges ? rows_named(rows).error : fit::kErrorOfFew;
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
