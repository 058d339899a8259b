#include "render/silhouette/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "penumbra/mesh/error.h"
#include "render/rays/each_receiver.h"

namespace penumbra {
namespace {

constexpr std::array<float, 5> kSpline{1.0f / 16, 1.0f / 4, 3.0f / 8, 1.0f / 4, 1.0f / 16};  // B3
constexpr float kLeast = 1e-4f;  // a difference that never matters

/// V and its variance; 0 where V is exact.
struct Estimate {
  float value = 1.0f, variance = 0.0f;
};

/// x to the power of 2^count.
template <int count>
float squared(float x) {
  for (int k = 0; k < count; ++k) x *= x;
  return x;
}

/// (1 - x/16)^16, which is exp(-x) but for what does not matter here, and 0 from 16 on.
float falloff(float x) {
  return squared<4>(std::max(0.0f, 1.0f - x / 16.0f));
}

float power_128(float x) {
  return squared<7>(x);
}

class Filter {
 public:
  Filter(const Receivers& pixels, const DenoiseOptions& options) : pixels_(pixels), options_(options) {}

  /// The variance that V = p has, with p the mean of the neighbors on the same surface.
  float variance(std::span<const Estimate> in, std::uint32_t i) const {
    float sum = 0.0f, weights = 0.0f;
    for_each_tap(i, 1, [&](std::uint32_t k, float spline) {
      const float weight = spline * weight_of(i, k, 0.0f);
      sum += weight * in[k].value;
      weights += weight;
    });
    const float p = sum / weights, n = static_cast<float>(options_.samples);
    return p * (1.0f - p) / (n * std::sqrt(n));
  }

  Estimate filtered(std::span<const Estimate> in, std::uint32_t i, int step) const {
    const float noise = static_cast<float>(options_.deviations) * std::sqrt(in[i].variance) + kLeast;
    float sum = 0.0f, variance = 0.0f, weights = 0.0f;
    for_each_tap(i, step, [&](std::uint32_t k, float spline) {
      const float difference = std::abs(in[k].value - in[i].value);
      const float weight = spline * weight_of(i, k, difference / noise);
      sum += weight * in[k].value;
      variance += weight * weight * in[k].variance;
      weights += weight;
    });
    return {sum / weights, variance / (weights * weights)};
  }

 private:
  template <class Tap>
  void for_each_tap(std::uint32_t i, int step, const Tap& tap) const {
    const int x = static_cast<int>(i) % pixels_.width, y = static_cast<int>(i) / pixels_.width;
    for (int row = -2; row <= 2; ++row)
      for (int column = -2; column <= 2; ++column) {
        const int u = x + step * column, v = y + step * row;
        if (u < 0 || v < 0 || u >= pixels_.width || v >= pixels_.height) continue;
        const auto k = static_cast<std::uint32_t>(v * pixels_.width + u);
        if (pixels_.objects[k] != pixels_.objects[i]) continue;
        tap(k, kSpline[static_cast<std::size_t>(row + 2)] * kSpline[static_cast<std::size_t>(column + 2)]);
      }
  }
  /// The weight of a neighbor whose value is so many times the noise away: less the more it lies on another
  /// surface.
  float weight_of(std::uint32_t i, std::uint32_t k, float deviations) const {
    if (i == k) return 1.0f;
    const Vec3& normal = pixels_.normals[i];
    const auto cosine = static_cast<float>(glm::dot(normal, pixels_.normals[k]));
    if (!(cosine > 0.0f)) return 0.0f;
    const Vec3 between = pixels_.points[k] - pixels_.points[i];
    const auto along = static_cast<float>(glm::dot(between, between));
    const auto out = static_cast<float>(std::abs(glm::dot(normal, between)));
    const float sine = along > 0.0f ? out / std::sqrt(along) : 0.0f;
    return falloff(sine * per_sine_ + deviations) * power_128(cosine);
  }

  const Receivers& pixels_;
  const DenoiseOptions& options_;
  const float per_sine_ = static_cast<float>(1.0 / options_.out_of_plane);
};

}  // namespace

std::vector<float> denoise(const Receivers& pixels, std::span<const float> noisy,
                           std::span<const std::uint32_t> open, const DenoiseOptions& options,
                           tbb::task_arena& threads, const Progress& progress) {
  if (!pixels.are_pixels() || !pixels.has_normals() || pixels.objects.empty())
    throw UsageError("denoise needs a picture's pixels as receivers, with normals and objects");
  const Filter filter(pixels, options);
  std::vector<Estimate> now(noisy.size());
  for (std::size_t i = 0; i < noisy.size(); ++i) now[i].value = noisy[i];
  std::vector<Estimate> next = now;
  const auto pass = [&](int index, const auto& estimate) {
    detail::for_each_receiver(
        threads, open.size(),
        part_of(progress, index / (options.levels + 1.0), (index + 1.0) / (options.levels + 1.0)),
        [&](std::size_t k) { next[open[k]] = estimate(open[k]); });
    now = next;
  };
  pass(0, [&](std::uint32_t i) { return Estimate{now[i].value, filter.variance(now, i)}; });
  for (int level = 0; level < options.levels; ++level)
    pass(level + 1, [&](std::uint32_t i) { return filter.filtered(now, i, 1 << level); });
  std::vector<float> out;
  out.reserve(now.size());
  for (const Estimate& estimate : now) out.push_back(estimate.value);
  return out;
}

}  // namespace penumbra
