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
constexpr std::size_t kReceivers = 512;  ///< looked at by rays
constexpr int kRays = 16;                ///< for each of them, twice
constexpr std::size_t kSeeing = 24;      ///< of each part, so many look at edges and faces
constexpr std::size_t kEdges = 1024, kFaces = 1024;
// A penumbra that fewer of the receivers than this lie in is taken for a usual one: O evenly spread over 0 to 1, and the
// boundaries of a few edges.
constexpr std::size_t kFew = 8;
constexpr double kUsualVariance = 1.0 / 6.0, kUsualBoundary = 0.3;

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
  spread_over(receivers.size(), kTries * kReceivers, [&](std::size_t i) {
    const auto index = static_cast<std::uint32_t>(i);
    if (out.size() < kReceivers && receivers.is_present(index) && !is_dark(index)) out.push_back(index);
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

/// What 2 · 16 rays tell of some receivers.
struct Seen {
  std::vector<std::uint32_t> lit, partly, hidden;
  double variance = kUsualVariance, boundary = kUsualBoundary;
};

/// Two independent estimates of each receiver's O: their product has no bias, and their difference is their error.
Seen see(const RayScene& rays, const LightShape& light, const Receivers& receivers,
         std::span<const std::uint32_t> some) {
  const auto estimate = [&](std::uint64_t seed) {
    return trace_reference(rays, light, receivers, some, {.samples = kRays, .seed = seed}, true).unoccluded;
  };
  const std::vector<float> first = estimate(1), second = estimate(2);
  Seen out;
  double variance = 0.0, error2 = 0.0;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const double a = first[i], b = second[i];
    (a + b <= 0.0 ? out.hidden : a + b < 2.0 ? out.partly : out.lit).push_back(some[i]);
    variance += 0.5 * (a * (1.0 - b) + b * (1.0 - a));
    error2 += 0.5 * (a - b) * (a - b);
  }
  if (out.partly.size() < kFew) return out;
  const auto count = static_cast<double>(out.partly.size());
  out.variance = variance / count;
  // 1 / e² = n / v + n^(3/2) / b, for the e of n rays that was seen.
  constexpr double kLeast = 1e-3;  // of a difference that no ray has seen, so that no error is taken for none
  const double rest = 1.0 / std::max(error2 / count, 1e-6) - kRays / std::max(out.variance, 1e-6);
  out.boundary = std::max(kLeast, kRays * std::sqrt(double{kRays}) / std::max(rest, 1e-3));
  return out;
}

/// Summed in their order, so that threads change nothing.
SampledPart mean_of(std::span<const SampledPart> each, double share) {
  SampledPart out{.share = share};
  const auto count = static_cast<double>(each.size());
  for (const SampledPart& one : each) {
    out.edges += one.edges / count;
    out.merged_edges += one.merged_edges / count;
    out.edge_length += one.edge_length / count;
    out.boxes += one.boxes / count;
  }
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
  const EdgeSample edges(objects, circle, casters, kEdges);
  const FaceSample faces(objects, casters, kFaces);
  const auto look = [&](const std::vector<std::uint32_t>& part) {
    const std::size_t count = std::min(part.size(), kSeeing);
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
    return mean_of(each, static_cast<double>(part.size()) / static_cast<double>(some.size()));
  };
  out.lit = look(seen.lit);
  out.penumbra = look(seen.partly);
  out.hidden = look(seen.hidden);
  return out;
}

}  // namespace penumbra::detail
