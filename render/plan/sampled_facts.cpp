#include "render/plan/sampled_facts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "render/plan/seen_edges.h"
#include "render/rays/reference.h"

namespace penumbra::detail {
namespace {

// Accuracy of the estimates against time: all in all about half a millisecond.
constexpr std::size_t kReceivers = 512;  ///< looked at by rays
constexpr int kRays = 16;                ///< for each of them
constexpr std::size_t kSeeing = 32;      ///< of those in penumbra, so many look at edges and faces
constexpr std::size_t kEdges = 1024, kFaces = 512;
// A penumbra that fewer of the receivers than this lie in is taken for a usual one: O evenly spread over 0 to 1.
constexpr std::size_t kFew = 8;
constexpr double kUsualVariance = 1.0 / 6.0;

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

}  // namespace

SampledFacts sample_light(const Scene& objects, const RayScene& rays, const CircularLight& circle,
                          const LightShape& light, const Receivers& receivers,
                          std::span<const CasterFacts> casters,
                          const std::function<bool(std::uint32_t)>& is_dark) {
  SampledFacts out;
  const std::vector<std::uint32_t> some = some_receivers(receivers, is_dark);
  out.receivers = some.size();
  if (some.empty()) return out;
  // By rays: which receivers are in penumbra.
  const std::vector<float> seen =
      trace_reference(rays, light, receivers, some, {.samples = kRays}, true).unoccluded;
  std::vector<std::uint32_t> partly;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const double o = seen[i];
    if (!(o > 0.0 && o < 1.0)) continue;
    partly.push_back(some[i]);
    out.variance += o * (1.0 - o) * kRays / (kRays - 1.0);
  }
  const auto count = static_cast<double>(partly.size());
  out.penumbra = count / static_cast<double>(some.size());
  out.variance = partly.size() < kFew ? kUsualVariance : out.variance / count;
  if (partly.empty()) return out;
  // By edges and faces: how much lies before these.
  if (partly.size() > kSeeing) partly.resize(kSeeing);
  const EdgeSample edges(objects, circle, casters, kEdges);
  const FaceSample faces(objects, casters, kFaces);
  for (const std::uint32_t index : partly) {
    const Vec3& x = receivers.points[index];
    const EdgeSample::Crossing seen_from_x = edges.crossing(x);
    out.edges += seen_from_x.edges;
    out.merged_edges += seen_from_x.merged;
    out.boxes += faces.boxes_on(x, way_to_center(circle, x), circle.is_distant());
  }
  const auto seeing = static_cast<double>(partly.size());
  out.edges /= seeing;
  out.merged_edges /= seeing;
  out.boxes /= seeing;
  return out;
}

}  // namespace penumbra::detail
