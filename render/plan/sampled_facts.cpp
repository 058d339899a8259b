#include "render/plan/sampled_facts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "render/plan/seen_edges.h"
#include "render/rays/ray_packets.h"
#include "render/rays/reference.h"

namespace penumbra::detail {
namespace {

// Accuracy of the estimates against time: all in all about half a millisecond.
constexpr std::size_t kFewest = 256, kMost = 1024;       ///< receivers looked at by rays; of a picture
constexpr std::size_t kOneOf = 64;                       ///< one of so many
constexpr int kRays = 16;                                ///< for each of them
constexpr std::size_t kPartly = 128;                     ///< of those that are partly lit so many have
constexpr int kMoreRays = 30;                            ///< so many more, twice
constexpr std::size_t kSeeing = 16, kSeeingPartly = 48;  ///< of each part so many look at edges and faces
constexpr std::size_t kEdges = 1024, kMostEdges = 4096, kOneEdgeOf = 32, kFaces = 1024;
// What is thought of a penumbra before anything is seen of it: that of a few edges. It weighs as much as so many receivers.
constexpr double kUsualVariance = 0.13, kUsualBoundary = 0.3, kUsualWeight = 3.0;

/// Indices below `count`, the first `wanted` of a sequence that fills the range evenly: multiples of the golden ratio.
template <class Visit>
void spread_over(std::size_t count, std::size_t wanted, const Visit& visit) {
  constexpr double kGolden = 0.6180339887498949;
  for (std::size_t k = 1; k <= wanted; ++k) {
    const double at = static_cast<double>(k) * kGolden;
    visit(std::min(count - 1, static_cast<std::size_t>((at - std::floor(at)) * static_cast<double>(count))));
  }
}

std::vector<std::uint32_t> some_receivers(const Receivers& receivers,
                                          const std::function<bool(std::uint32_t)>& is_dark) {
  constexpr std::size_t kTries = 4;  // pictures are mostly full
  std::vector<std::uint32_t> out;
  if (receivers.size() == 0) return out;
  const std::size_t wanted = std::clamp(receivers.size() / kOneOf, kFewest, kMost);
  spread_over(receivers.size(), kTries * wanted, [&](std::size_t i) {
    const auto index = static_cast<std::uint32_t>(i);
    if (out.size() < wanted && receivers.is_present(index) && !is_dark(index)) out.push_back(index);
  });
  return out;
}

/// How many boxes of faces lie on the way from a receiver to the light's center, or to the first face on it.
double boxes_before(const FaceSample& faces, const RayScene& rays, const CircularLight& light,
                    const Receivers& receivers, std::uint32_t index) {
  Ray ray{.from = start_of(receivers, index),
          .way = way_to_center(light, receivers.points[index]),
          .endless = light.is_distant()};
  if (const auto hit = first_hit(rays, ray))
    return faces.boxes_on(ray.from.point, hit->distance * ray.way, false);
  return faces.boxes_on(ray.from.point, ray.way, ray.endless);
}

/// What rays tell of some receivers.
struct Seen {
  std::vector<std::uint32_t> lit, partly, hidden;
  /// Receivers that are partly lit though the first rays found them lit or hidden, about.
  double missed_lit = 0.0, missed_hidden = 0.0;
  double variance = kUsualVariance, boundary = kUsualBoundary;
};

double squared_error(double samples, double variance, double boundary) {
  return 1.0 / (samples / variance + samples * std::sqrt(samples) / boundary);
}

/// Two independent estimates of O for receivers that the first rays found partly lit: their product has no bias, and their
/// difference is their error. A receiver stands for all that the first rays find with its probability.
void look_again(const RayScene& rays, const LightShape& light, const Receivers& receivers, Seen& seen) {
  const std::span<const std::uint32_t> some(seen.partly.data(), std::min(seen.partly.size(), kPartly));
  if (some.empty()) return;
  const auto estimate = [&](std::uint64_t seed) {
    return trace_reference(rays, light, receivers, some, {.samples = kMoreRays, .seed = seed}, true)
        .unoccluded;
  };
  const std::vector<float> first = estimate(2), second = estimate(3);
  const double each = static_cast<double>(seen.partly.size()) / static_cast<double>(some.size());
  double weights = kUsualWeight, variance = kUsualWeight * kUsualVariance;
  double error2 = kUsualWeight * squared_error(kMoreRays, kUsualVariance, kUsualBoundary);
  for (std::size_t i = 0; i < some.size(); ++i) {
    const double a = first[i], b = second[i];
    const double o = std::clamp(0.5 * (a + b), 0.25 / kMoreRays, 1.0 - 0.25 / kMoreRays);
    const double found = 1.0 - std::pow(o, kRays) - std::pow(1.0 - o, kRays);
    (o > 0.5 ? seen.missed_lit : seen.missed_hidden) += each * (1.0 / found - 1.0);
    weights += 1.0 / found;
    variance += 0.5 * (a * (1.0 - b) + b * (1.0 - a)) / found;
    error2 += 0.5 * (a - b) * (a - b) / found;
  }
  seen.variance = std::max(1e-6, variance / weights);
  // 1 / e² = n / v + n^(3/2) / b, for the e of n rays that was seen.
  const double rest = weights / error2 - kMoreRays / seen.variance;
  seen.boundary = kMoreRays * std::sqrt(double{kMoreRays}) / std::max(rest, 1e-3);
}

Seen see(const RayScene& rays, const LightShape& light, const Receivers& receivers,
         std::span<const std::uint32_t> some) {
  const std::vector<float> open =
      trace_reference(rays, light, receivers, some, {.samples = kRays, .seed = 1}, true).unoccluded;
  Seen out;
  for (std::size_t i = 0; i < some.size(); ++i)
    (open[i] <= 0.0f ? out.hidden : open[i] < 1.0f ? out.partly : out.lit).push_back(some[i]);
  look_again(rays, light, receivers, out);
  return out;
}

/// Summed in their order, so that threads change nothing. `least`: edges that may be there though none was seen.
SampledPart mean_of(std::span<const SampledPart> each, double share, double least) {
  SampledPart out{.share = share};
  const auto count = static_cast<double>(each.size());
  for (const SampledPart& one : each) {
    out.edges += one.edges / count;
    out.merged_edges += one.merged_edges / count;
    out.edge_length += one.edge_length / count;
    out.boxes += one.boxes / count;
    out.edges_each.push_back(std::max(one.edges, least));
  }
  std::ranges::sort(out.edges_each);
  return out;
}

}  // namespace

SampledFacts sample_light(const Scene& objects, const RayScene& rays, const CircularLight& circle,
                          const LightShape& light, const Receivers& receivers,
                          std::span<const CasterFacts> casters,
                          const std::function<bool(std::uint32_t)>& is_dark) {
  const std::vector<std::uint32_t> some = some_receivers(receivers, is_dark);
  SampledFacts out{.receivers = some.size(), .variance = kUsualVariance, .boundary = kUsualBoundary};
  if (some.empty()) return out;
  const Seen seen = see(rays, light, receivers, some);
  out.variance = seen.variance;
  out.boundary = seen.boundary;
  // By edges and faces: how much lies before them.
  std::size_t all_edges = 0;
  for (const CasterFacts& caster : casters) all_edges += caster.edges;
  const EdgeSample edges(objects, circle, casters, std::clamp(all_edges / kOneEdgeOf, kEdges, kMostEdges));
  out.band_edges = edges.band();
  const FaceSample faces(objects, casters, kFaces);
  const auto look = [&](const std::vector<std::uint32_t>& part, std::size_t most, double missed) {
    const std::size_t count = std::min(part.size(), most);
    std::vector<SampledPart> each(count);
    rays.arena().execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        const EdgeSample::Crossing crossing = edges.crossing(receivers.points[part[i]]);
        each[i] = {.edges = crossing.edges,
                   .merged_edges = crossing.merged,
                   .edge_length = crossing.length,
                   .boxes = boxes_before(faces, rays, circle, receivers, part[i])};
      });
    });
    const double share = std::max(0.0, static_cast<double>(part.size()) + missed);
    return mean_of(each, share / static_cast<double>(some.size()),
                   edges.each_stands_for() > 1.0 ? 0.5 * edges.each_stands_for() : 0.0);
  };
  out.lit = look(seen.lit, kSeeing, -seen.missed_lit);
  out.penumbra = look(seen.partly, kSeeingPartly, seen.missed_lit + seen.missed_hidden);
  out.hidden = look(seen.hidden, kSeeing, -seen.missed_hidden);
  return out;
}

}  // namespace penumbra::detail
