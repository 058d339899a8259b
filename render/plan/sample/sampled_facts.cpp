#include "render/plan/sample/sampled_facts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "render/plan/sample/ray_pilots.h"
#include "render/plan/sample/seen_edges.h"
#include "render/rays/ray_packets.h"

namespace penumbra::detail {
namespace {

// Accuracy of the estimates against time: all in all about half a millisecond.
constexpr std::size_t kFewest = 256, kMost = 1024;       ///< receivers looked at by rays; of a picture
constexpr std::size_t kOneOf = 96;                       ///< one of so many
constexpr std::size_t kPartly = 128;                     ///< of those that are partly lit so many have
constexpr int kMoreRays = 30;                            ///< so many more, twice
constexpr std::size_t kSeeing = 16, kSeeingPartly = 48;  ///< of each part so many look at edges and faces
constexpr std::size_t kEdges = 1024, kMostEdges = 2048, kOneEdgeOf = 32, kFaces = 1024;

/// Indices below `count`, the first `wanted` of a sequence that fills the range evenly: multiples of the
/// golden ratio.
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

/// Summed in their order, so that threads change nothing. `least`: edges that may be there though none was
/// seen.
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

/// Looks at a light in steps, each of which rests on those before.
class Look {
 public:
  Look(const Scene& objects, const RayScene& rays, const CircularLight& circle, const LightShape& light,
       const Receivers& receivers, std::span<const CasterFacts> casters)
      : rays_(rays),
        circle_(circle),
        light_(light),
        receivers_(receivers),
        edges_(objects, circle, casters, edges_for(casters)),
        faces_(objects, casters, kFaces) {}

  void look_at(std::span<const std::uint32_t> some, SampledFacts& out) {
    seen_ = see_with_few_rays(rays_, light_, receivers_, some);
    out.band_edges = edges_.band();
    out.edges_a_sample = edges_.each_stands_for();
    const FirstLook first = first_pilot(out);
    const auto all = static_cast<double>(some.size());
    out.lit = part(seen_.lit, kSeeing, -first.missed_lit, all);
    out.penumbra = part(seen_.partly, kSeeingPartly, first.missed_lit + first.missed_hidden, all);
    out.hidden = part(seen_.hidden, kSeeing, -first.missed_hidden, all);
  }

  /// At receivers that the first one has not, where there are so many.
  void second_pilot(const PilotWish& wish, SampledFacts& out) const {
    if (wish.receivers == 0 || near_.empty()) return;
    const auto some = std::span(near_).last(std::min(wish.receivers, near_.size()));
    out.pilots.push_back(pilot(some, Twice(rays_, light_, receivers_, some, wish.samples, 4)));
  }

 private:
  static std::size_t edges_for(std::span<const CasterFacts> casters) {
    std::size_t all = 0;
    for (const CasterFacts& caster : casters) all += caster.edges;
    return std::clamp(all / kOneEdgeOf, kEdges, kMostEdges);
  }

  FirstLook first_pilot(SampledFacts& out) {
    near_ = with_neighbors(rays_, light_, receivers_, seen_.partly, kPartly);
    const std::span<const PartlyLit> some = std::span(near_).first(std::min(near_.size(), kPartly));
    const Twice twice(rays_, light_, receivers_, some, kMoreRays, 2);
    out.pilots.push_back(pilot(some, twice));
    FirstLook first(twice, some, seen_.partly.size());
    out.variance = first.variance;
    out.boundary = first.boundary;
    return first;
  }

  RayPilot pilot(std::span<const PartlyLit> some, const Twice& seen) const {
    RayPilot out{.samples = seen.samples(), .each = std::vector<RayPilot::Receiver>(some.size())};
    for_each(some.size(), [&](std::size_t i) {
      out.each[i] = {seen.weight(i), seen.error2(i), edges_.crossing(receivers_.points[some[i].index]).edges,
                     some[i].group};
    });
    return out;
  }

  /// How much lies before receivers that are alike.
  SampledPart part(std::span<const std::uint32_t> all_of_it, std::size_t most, double missed,
                   double all) const {
    std::vector<SampledPart> each(std::min(all_of_it.size(), most));
    for_each(each.size(), [&](std::size_t i) {
      const EdgeSample::Crossing crossing = edges_.crossing(receivers_.points[all_of_it[i]]);
      each[i] = {.edges = crossing.edges,
                 .merged_edges = crossing.merged,
                 .edge_length = crossing.length,
                 .boxes = boxes_before(faces_, rays_, circle_, receivers_, all_of_it[i])};
    });
    const double share = std::max(0.0, static_cast<double>(all_of_it.size()) + missed);
    const double unseen = edges_.each_stands_for() > 1.0 ? 0.5 * edges_.each_stands_for() : 0.0;
    return mean_of(each, share / all, unseen);
  }

  template <class Visit>
  void for_each(std::size_t count, const Visit& visit) const {
    rays_.arena().execute([&] { tbb::parallel_for(std::size_t{0}, count, visit); });
  }

  const RayScene& rays_;
  const CircularLight& circle_;
  const LightShape& light_;
  const Receivers& receivers_;
  EdgeSample edges_;
  FaceSample faces_;
  Seen seen_;
  std::vector<PartlyLit> near_;
};

}  // namespace

SampledFacts sample_light(const Scene& objects, const RayScene& rays, const CircularLight& circle,
                          const LightShape& light, const Receivers& receivers,
                          std::span<const CasterFacts> casters,
                          const std::function<bool(std::uint32_t)>& is_dark,
                          const std::function<PilotWish(const SampledFacts&)>& wish) {
  const std::vector<std::uint32_t> some = some_receivers(receivers, is_dark);
  SampledFacts out{.receivers = some.size(), .variance = kUsualVariance, .boundary = kUsualBoundary};
  if (some.empty()) return out;
  std::optional<Look> look;
  rays.arena().execute([&] { look.emplace(objects, rays, circle, light, receivers, casters); });
  look->look_at(some, out);
  look->second_pilot(wish(out), out);
  return out;
}

}  // namespace penumbra::detail
