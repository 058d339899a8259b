#include "render/plan/cost_model.h"

#include <algorithm>
#include <cmath>

#include "render/plan/cost_model_fit.h"
#include "render/plan/sample/ray_error.h"

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

/// Of a receiver with so many rays.
double nanoseconds_of_rays(const CasterTotals& casters, const SampledPart& part, int samples) {
  const double both = std::sqrt(part.boxes * part.edges);
  const double ray = fit::kRay + fit::kRayLogFaces * std::log2(1.0 + casters.faces) +
                     fit::kRayRootOfBoxes * std::sqrt(part.boxes) +
                     fit::kRayRootOfEdges * std::sqrt(part.edges) + fit::kRayRootOfBoth * both;
  return fit::kRayReceiver + fit::kRayReceiverRootOfBoth * both + samples * ray;
}

/// Of a receiver whose area is integrated.
double nanoseconds_of_area(const SampledPart& part) {
  return fit::kSilhouetteMerged * part.merged_edges + fit::kSilhouetteRootOfEdges * std::sqrt(part.edges) +
         fit::kSilhouetteLength * part.edge_length;
}

/// Of hierarchies over edges, and over those of merged faces.
double nanoseconds_of_setup(double edges, bool merges) {
  const double merging = fit::kMergingEdge * edges + fit::kMergingEdgeTimesRoot * edges * std::sqrt(edges);
  return fit::kHierarchyEdge * edges + (merges ? merging : 0.0);
}

/// Of a part's receivers, those that see few edges: their share, and that of the part's edges that these see.
struct Few {
  double share = 0.0, of_edges = 0.0;
};
Few few_of(const SampledPart& part, int up_to) {
  if (up_to <= 0) return {};
  if (part.edges_each.empty()) return part.edges <= up_to ? Few{1.0, 1.0} : Few{};
  double count = 0.0, few = 0.0, all = 0.0;
  for (const double edges : part.edges_each) {
    all += edges;
    if (edges > up_to) continue;
    ++count;
    few += edges;
  }
  return {count / static_cast<double>(part.edges_each.size()), all > 0.0 ? few / all : 1.0};
}

double root_of_edges_of(const SampledPart& part) {
  return std::sqrt(part.edges);
}
double boxes_of(const SampledPart& part) {
  return part.boxes;
}

// Up to so many edges are integrated exactly, without rows (docs/methods/silhouette.md).
constexpr double kFewEdges = 20.0;

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

bool is_worth_leaving_out(const LightFacts& facts) {
  std::size_t faces = 0;
  for (const CasterFacts& caster : facts.casters) faces += caster.faces;
  return 2.0 * totals_of_reaching(facts).faces <= static_cast<double>(faces);
}

double edges_of_method(const LightFacts& facts) {
  if (is_worth_leaving_out(facts)) return totals_of_reaching(facts).edges;
  double edges = 0.0;
  for (const CasterFacts& caster : facts.casters) edges += static_cast<double>(caster.edges);
  return edges;
}

Cost cost_of_silhouette(const LightFacts& facts, bool merges) {
  const double edges = totals_of_reaching(facts).edges;
  const SampledFacts& s = facts.sampled;
  const double areas = mean(s, nanoseconds_of_area);
  return in_milliseconds(
      reached(facts) * (fit::kSilhouetteReceiver + areas + fit::kSilhouetteBox * mean(s, boxes_of)) +
          fit::kSilhouetteCasterEdge * edges + fit::kSilhouetteBandEdge * s.band_edges,
      nanoseconds_of_setup(edges_of_method(facts), merges));
}

Cost cost_of_rays(const LightFacts& facts, int samples, int areas_up_to) {
  const CasterTotals casters = totals_of_reaching(facts);
  const SampledFacts& s = facts.sampled;
  // Those that certificates leave open: a part of the penumbra, and of other receivers before which edges
  // lie. Of these some have few edges, and areas.
  const auto open = [&](const SampledPart& part, double share) {
    const Few few = few_of(part, areas_up_to);
    return part.share * share *
           (few.of_edges * nanoseconds_of_area(part) +
            (1.0 - few.share) * nanoseconds_of_rays(casters, part, samples));
  };
  const double rest = open(s.hidden, std::min(1.0, s.hidden.edges)) + open(s.lit, std::min(1.0, s.lit.edges));
  const double looked_at =
      mean(s, [&](const SampledPart& part) { return std::min(part.edges, double{kEdgesOfRay} * samples); });
  return in_milliseconds(
      reached(facts) * (fit::kRaysReceiver + fit::kRaysRootOfEdges * mean(s, root_of_edges_of) +
                        fit::kRaysEdge * looked_at + fit::kRaysBox * mean(s, boxes_of) +
                        fit::kRaysOpenPenumbra * open(s.penumbra, 1.0) + fit::kRaysOpenRest * rest) +
          fit::kRaysCasterEdge * casters.edges + fit::kRaysBandEdge * s.band_edges,
      nanoseconds_of_setup(edges_of_method(facts), false));
}

int areas_up_to(const LightFacts& facts, int samples) {
  constexpr double kUsual = 60.0;  // nanoseconds an edge, where no edge was seen
  constexpr double kLeast = 3.0, kMost = 65'536.0;
  const SampledPart& part = facts.sampled.penumbra;
  const double edge = part.edges > 0.0 ? nanoseconds_of_area(part) / part.edges : kUsual;
  const double edges = nanoseconds_of_rays(totals_of_reaching(facts), part, samples) / std::max(edge, 1.0);
  return edges < kLeast ? 0 : static_cast<int>(std::min(edges, kMost));
}

Cost cost_of_reference(const LightFacts& facts, int samples) {
  const CasterTotals casters = totals_of_reaching(facts);
  const double each =
      mean(facts.sampled, [&](const SampledPart& p) { return nanoseconds_of_rays(casters, p, samples); });
  return in_milliseconds(reached(facts) * each, 0.0);
}

double error_of_silhouette(const LightFacts& facts) {
  return facts.sampled.penumbra.edges > kFewEdges ? fit::kErrorOfMany : fit::kErrorOfFew;
}

double error_of_rays(const LightFacts& facts, int samples, int areas_up_to) {
  const double of_areas = areas_up_to > 0 ? error_of_silhouette(facts) : 0.0;
  return std::hypot(of_areas, std::sqrt(squared_error_kept(facts.sampled, samples, areas_up_to)));
}

int rays_for(const LightFacts& facts, double error, bool with_areas) {
  constexpr int kLeast = 4, kMost = 512;  // halves of a side
  const auto samples_of = [](int k) { return (k / 2) * (k - k / 2); };
  const auto keeps = [&](int k) {
    const int samples = samples_of(k);
    return error_of_rays(facts, samples, with_areas ? areas_up_to(facts, samples) : 0) <= error;
  };
  int low = kLeast - 1, high = kMost;  // errors fall with the number of rays
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (keeps(middle) ? high : low) = middle;
  }
  return samples_of(high);
}

double milliseconds_in_penumbra(const LightFacts& facts, int samples) {
  return kMillisecondsPerNanosecond *
         nanoseconds_of_rays(totals_of_reaching(facts), facts.sampled.penumbra, samples);
}

}  // namespace penumbra::detail
