#include "render/d_buffer/resampler.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

// Accuracy, found by trial over the scenes of Resampler.LessensTheError and random poses
// (d_buffer_poses_test.cpp).

/// Least cosine between the normals of two pixels that count as one surface. Smaller: samples spread over
/// creases.
constexpr double kSameSurfaceCosine = 0.9;
/// The same where samples are averaged. Smaller: the shadow on a curved surface is blurred
/// (Resampler.NoiseOfSamplesIsAveragedOnFlatGroundOnly).
constexpr double kFlatCosine = 0.998;
/// Greatest height above the neighbor's plane over the distance of two pixels that count as one surface.
constexpr double kSameSurfaceSlope = 0.5;
/// A difference of so many times the noise of the samples is no longer noise. Smaller: noise replaces entries
/// that are right (Resampler.AProbePixelThatErrsByItsNoiseChangesNothing).
constexpr float kNoiseExplains = 2.0f;
/// Samples that differ by more across a pixel, or bend by more at it, are not averaged: that is no noise.
constexpr float kNoAverage = 0.3f;
/// Root mean square error of one sample of CenterRays::sampled_visibility where one edge crosses the disk,
/// and of the mean of nine neighbors, whose patterns complement each other. Both are measured.
constexpr float kNoiseOfOne = 0.037f, kNoiseOfNine = 0.007f;
/// With less of the disk above the horizon than this, visibility counts as 1: a sliver is all rounding.
constexpr float kSliver = 0.05f;

// Speed.

/// Pixels from one probe pixel to the next, along rows and along columns. Smaller: more samples; larger:
/// smaller surfaces with wrong entries are missed (DBuffer.APostBelowTheLampDoesNotDarkenTheFloor).
constexpr int kProbesInShadow = 8, kProbesInLight = 16;

constexpr float kNoSample = -1.0f;

/// Without a branch in the loop, so that it vectorizes.
PENUMBRA_VECTOR_CLONES
bool any_apart(const float* a, const float* b, std::uint32_t count) {
  int any = 0;
  for (std::uint32_t i = 0; i < count; ++i) any |= std::abs(a[i] - b[i]) > kDiscontinuity;
  return any != 0;
}

template <class F>
void for_neighbors(const ImageSurface& image, std::uint32_t i, const F& visit) {
  const auto width = static_cast<std::uint32_t>(image.receivers.width);
  const std::uint32_t x = i % width;
  if (x > 0) visit(i - 1);
  if (x + 1 < width) visit(i + 1);
  if (i >= width) visit(i - width);
  if (i + width < image.receivers.size()) visit(i + width);
}

bool is_one_surface(const ImageSurface& image, std::uint32_t i, std::uint32_t j, double least_cosine) {
  const Receivers& of = image.receivers;
  if (!of.is_present(i) || !of.is_present(j)) return false;
  const Vec3 &n = of.normals[i], way = of.points[j] - of.points[i];
  return glm::dot(n, of.normals[j]) > least_cosine &&
         std::abs(glm::dot(n, way)) <= kSameSurfaceSlope * glm::length(way);
}

float noise_of_mean(int samples) {
  return samples == 9 ? kNoiseOfNine : kNoiseOfOne / std::sqrt(static_cast<float>(samples));
}

/// Visibility as a part of what is above the horizon.
float share_of(float open, float visibility) {
  return open > kSliver ? visibility / open : 1.0f;
}

/// The next one on the line from i through j; j at the image's border.
std::uint32_t beyond(const ImageSurface& image, std::uint32_t i, std::uint32_t j) {
  const auto width = static_cast<std::uint32_t>(image.receivers.width);
  const std::uint32_t next = 2 * j - i;  // wraps to a great number above the first row
  const std::uint32_t column = j % width;
  const bool sideways = j / width == i / width;
  return next >= image.receivers.size() || (sideways && (column == 0 || column + 1 == width)) ? j : next;
}

}  // namespace

void Resampler::begin() {
  share_.resize(visibility_.size());
  sample_.assign(visibility_.size(), kNoSample);
  reason_.assign(visibility_.size(), kNotSampled);
  sampled_.clear();
  before_ = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, share_.size(), 8192), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      share_[i] = share_of(image_.open[i], visibility_[i]);
  });
}

std::vector<std::uint32_t> Resampler::find_first(std::span<const std::uint32_t> always,
                                                 std::span<const std::uint32_t> suspects) {
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> parts;
  tbb::parallel_for(tbb::blocked_range<int>(0, image_.receivers.height, 16), [&](const auto& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) find_in_row(y, parts.local());
  });
  std::vector<std::uint32_t> out(always.begin(), always.end());
  for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  for (const std::uint32_t i : out) reason_[i] = kContradiction;
  std::vector<std::uint32_t> others = probe_pixels();
  others.insert(others.end(), suspects.begin(), suspects.end());
  for (const std::uint32_t i : others) {
    if (reason_[i] != kNotSampled) continue;
    reason_[i] = kProbe;
    out.push_back(i);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::uint32_t> Resampler::probe_pixels() const {
  std::vector<std::uint32_t> out;
  const Receivers& of = image_.receivers;
  for (int y = kProbesInShadow / 2; y < of.height; y += kProbesInShadow)
    for (int x = kProbesInShadow / 2; x < of.width; x += kProbesInShadow) {
      const auto i = static_cast<std::uint32_t>(y * of.width + x);
      const bool wanted = visibility_[i] < image_.open[i] ||
                          (x % kProbesInLight < kProbesInShadow && y % kProbesInLight < kProbesInShadow);
      if (wanted && of.is_present(i) && image_.open[i] > 0.0f) out.push_back(i);
    }
  return out;
}

void Resampler::find_in_row(int y, std::vector<std::uint32_t>& out) const {
  const auto width = static_cast<std::uint32_t>(image_.receivers.width);
  const std::uint32_t begin = static_cast<std::uint32_t>(y) * width;
  find_between(begin, width - 1, 1, out);
  if (y + 1 < image_.receivers.height) find_between(begin, width, width, out);
}

void Resampler::find_between(std::uint32_t begin, std::uint32_t count, std::uint32_t apart,
                             std::vector<std::uint32_t>& out) const {
  constexpr std::uint32_t kBlock = 64;
  for (std::uint32_t i = begin, end = begin + count; i < end; i += kBlock) {
    const std::uint32_t n = std::min(kBlock, end - i);
    if (!any_apart(&share_[i], &share_[i + apart], n)) continue;
    for (std::uint32_t k = i; k < i + n; ++k)
      if (is_discontinuity(k, k + apart)) out.insert(out.end(), {k, k + apart});
  }
}

bool Resampler::is_discontinuity(std::uint32_t i, std::uint32_t j) const {
  const float jump = share_[j] - share_[i];
  if (!(std::abs(jump) > kDiscontinuity)) return false;
  const float before = share_[i] - share_[beyond(image_, j, i)];
  const float after = share_[beyond(image_, i, j)] - share_[j];
  if (!(std::abs(jump - before) > kDiscontinuity && std::abs(jump - after) > kDiscontinuity)) return false;
  return is_one_surface(image_, i, j, kSameSurfaceCosine);
}

std::vector<std::uint32_t> Resampler::take(std::span<const std::uint32_t> pixels,
                                           std::span<const float> samples) {
  for (std::size_t k = 0; k < pixels.size(); ++k) sample_[pixels[k]] = samples[k];
  const std::size_t again = before_;
  before_ = sampled_.size();
  sampled_.insert(sampled_.end(), pixels.begin(), pixels.end());
  denied_.resize(sampled_.size() - again);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, denied_.size(), 256), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k)
      denied_[k] = difference(sampled_[again + k], mean_sample(sampled_[again + k])) > 1.0f;
  });
  std::vector<std::uint32_t> next;
  for (std::size_t k = 0; k < denied_.size(); ++k) {
    if (!denied_[k]) continue;
    const std::uint32_t i = sampled_[again + k];
    for_neighbors(image_, i, [&](std::uint32_t j) {
      if (reason_[j] != kNotSampled || !is_one_surface(image_, i, j, kSameSurfaceCosine)) return;
      reason_[j] = reason_[i];
      next.push_back(j);
    });
  }
  return next;
}

Resampler::Mean Resampler::mean_sample(std::uint32_t i) const {
  const auto width = static_cast<std::uint32_t>(image_.receivers.width);
  if (i < width || i + width >= sample_.size() || i % width == 0 || i % width == width - 1)
    return {sample_[i], by_entries(i), 1};
  float seen = sample_[i], open = image_.open[i], said = by_entries(i);
  int samples = 1;
  for (const std::uint32_t d : {1u, width - 1, width, width + 1}) {
    if (sample_[i - d] == kNoSample || sample_[i + d] == kNoSample) continue;
    if (!is_one_surface(image_, i, i - d, kFlatCosine) || !is_one_surface(image_, i, i + d, kFlatCosine))
      continue;
    const float before = sample_[i - d], after = sample_[i + d];
    if (std::abs(0.5f * (before + after) - sample_[i]) > kNoAverage || std::abs(before - after) > kNoAverage)
      continue;
    seen += sample_[i - d] + sample_[i + d];
    open += image_.open[i - d] + image_.open[i + d];
    said += by_entries(i - d) + by_entries(i + d);
    samples += 2;
  }
  const float scale = open > 0.0f ? image_.open[i] / open : 0.0f;
  return {scale * seen, scale * said, samples};
}

float Resampler::difference(std::uint32_t i, const Mean& mean) const {
  float most = std::abs(mean.visibility - by_entries(i));
  if (reason_[i] == kProbe) most = std::min(most, std::abs(mean.visibility - mean.by_entries));
  return most / (kNoiseExplains * noise_of_mean(mean.samples));
}

void Resampler::settle() {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sampled_.size(), 512), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const std::uint32_t i = sampled_[k];
      const Mean mean = mean_sample(i);
      // Where a few samples about a probe pixel deny the entries, it is noise more often than not.
      const float belief = mean.samples < 9 && reason_[i] == kProbe ? 0.5f : 1.0f;
      const float weight = std::clamp(2.0f * belief * difference(i, mean) - 1.0f, 0.0f, 1.0f);
      visibility_[i] += weight * (mean.visibility - visibility_[i]);
    }
  });
}

std::vector<std::uint32_t> isolated_pixels(const ImageSurface& image) {
  std::vector<char> is_isolated(image.receivers.size());
  tbb::parallel_for(std::size_t{0}, is_isolated.size(), [&](std::size_t pixel) {
    const auto i = static_cast<std::uint32_t>(pixel);
    int together = 0;
    for_neighbors(image, i,
                  [&](std::uint32_t j) { together += is_one_surface(image, i, j, kSameSurfaceCosine); });
    is_isolated[pixel] = image.receivers.is_present(pixel) && together < 2;
  });
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < is_isolated.size(); ++i)
    if (is_isolated[i]) out.push_back(i);
  return out;
}

std::size_t Resampler::resample(const ImageSurface& image, std::span<const std::uint32_t> always,
                                std::span<const std::uint32_t> suspects, const SampleVisibility& sample,
                                std::span<float> visibility) {
  image_ = image;
  visibility_ = visibility;
  begin();
  for (std::vector<std::uint32_t> pixels = find_first(always, suspects); !pixels.empty();)
    pixels = take(pixels, sample(pixels));
  settle();
  return sampled_.size();
}

}  // namespace penumbra::detail
