#include "render/plan/sample/ray_pilots.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra::detail {
namespace {

constexpr int kFewRays = 16;
/// Pixels to the right and down. Each has its opposite, so that no side is preferred.
constexpr std::array<std::array<int, 2>, 4> kNear{{{3, 1}, {-3, -1}, {-1, 3}, {1, -3}}};

std::vector<float> open_by_few_rays(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                                    std::span<const std::uint32_t> some) {
  return trace_reference(rays, light, receivers, some, {.samples = kFewRays, .seed = 1}, true).unoccluded;
}

std::vector<std::uint32_t> indices_of(std::span<const PartlyLit> some) {
  std::vector<std::uint32_t> out;
  for (const PartlyLit& each : some) out.push_back(each.index);
  return out;
}

/// Pixels near one of a picture.
std::vector<PartlyLit> near(const Receivers& receivers, const PartlyLit& of) {
  const auto width = static_cast<int>(receivers.width);
  const int height = static_cast<int>(receivers.size()) / width;
  const int column = static_cast<int>(of.index) % width, row = static_cast<int>(of.index) / width;
  std::vector<PartlyLit> out;
  for (const auto& [right, down] : kNear) {
    const int x = column + right, y = row + down;
    if (x < 0 || x >= width || y < 0 || y >= height) continue;
    const auto index = static_cast<std::uint32_t>(y * width + x);
    if (receivers.is_present(index)) out.push_back({index, of.group});
  }
  return out;
}

}  // namespace

Seen see_with_few_rays(const RayScene& rays, const LightShape& light, const Receivers& receivers,
                       std::span<const std::uint32_t> some) {
  const std::vector<float> open = open_by_few_rays(rays, light, receivers, some);
  Seen out;
  for (std::size_t i = 0; i < some.size(); ++i)
    (open[i] <= 0.0f ? out.hidden : open[i] < 1.0f ? out.partly : out.lit).push_back(some[i]);
  return out;
}

std::vector<PartlyLit> with_neighbors(const RayScene& rays, const LightShape& light,
                                      const Receivers& receivers, std::span<const std::uint32_t> partly,
                                      std::size_t wanted) {
  std::vector<PartlyLit> out;
  for (const std::uint32_t index : partly) out.push_back({index, static_cast<std::uint32_t>(out.size())});
  if (out.size() >= wanted || !receivers.are_pixels()) return out;
  std::vector<PartlyLit> beside;
  for (const PartlyLit& each : out)
    for (const PartlyLit& other : near(receivers, each)) beside.push_back(other);
  beside.resize(std::min(beside.size(), wanted));
  const std::vector<float> open = open_by_few_rays(rays, light, receivers, indices_of(beside));
  for (std::size_t i = 0; i < beside.size() && out.size() < wanted; ++i)
    if (open[i] > 0.0f && open[i] < 1.0f) out.push_back(beside[i]);
  std::ranges::stable_sort(out, {}, &PartlyLit::group);
  return out;
}

Twice::Twice(const RayScene& rays, const LightShape& light, const Receivers& receivers,
             std::span<const PartlyLit> some, int samples, std::uint64_t seed) {
  const std::vector<std::uint32_t> indices = indices_of(some);
  const auto trace = [&](std::uint64_t by) {
    return trace_reference(rays, light, receivers, indices, {.samples = samples, .seed = by}, true);
  };
  first_ = trace(seed);
  second_ = trace(seed + 1);
}

double Twice::open(std::size_t i) const {
  const double least = 0.25 / samples();
  return std::clamp(0.5 * (first_.unoccluded[i] + double{second_.unoccluded[i]}), least, 1.0 - least);
}

double Twice::weight(std::size_t i) const {
  const double o = open(i);
  return 1.0 / (1.0 - std::pow(o, kFewRays) - std::pow(1.0 - o, kFewRays));
}

double Twice::variance(std::size_t i) const {
  const double a = first_.visibility[i], b = second_.visibility[i];
  return 0.5 * (a * (1.0 - b) + b * (1.0 - a));
}

double Twice::error2(std::size_t i) const {
  const double difference = first_.visibility[i] - double{second_.visibility[i]};
  return 0.5 * difference * difference;
}

FirstLook::FirstLook(const Twice& seen, std::span<const PartlyLit> some, std::size_t found) {
  const double each = static_cast<double>(found) / std::max(1.0, static_cast<double>(some.size()));
  double weights = kUsualWeight, variances = kUsualWeight * kUsualVariance;
  double error2 = kUsualWeight * squared_error(seen.samples(), kUsualVariance, kUsualBoundary);
  for (std::size_t i = 0; i < some.size(); ++i) {
    const double weight = seen.weight(i);
    (seen.open(i) > 0.5 ? missed_lit : missed_hidden) += each * (weight - 1.0);
    weights += weight;
    variances += weight * seen.variance(i);
    error2 += weight * seen.error2(i);
  }
  variance = std::max(1e-6, variances / weights);
  // 1 / e² = n / v + n^(3/2) / b, for the e of n rays that was seen.
  const double n = seen.samples(), rest = weights / error2 - n / variance;
  boundary = n * std::sqrt(n) / std::max(rest, 1e-3);
}

}  // namespace penumbra::detail
