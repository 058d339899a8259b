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
/// Root mean square error of one sample of CenterRays::seen_points where one edge crosses the disk,
/// and of the mean of nine neighbors, whose patterns complement each other. Both are measured.
constexpr int kAllSamples = 9;
constexpr float kNoiseOfOne = 0.037f, kNoiseOfNine = 0.007f;
/// Where the two means of mean_sample differ by more the pixel is sampled at all points. Smaller: slower.
constexpr float kMostBend = 0.05f;
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

template <class F>
void for_all_around(const ImageSurface& image, std::uint32_t i, const F& visit) {
  const int width = image.receivers.width, height = image.receivers.height;
  const int column = static_cast<int>(i) % width, row = static_cast<int>(i) / width;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, height - 1); ++y)
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, width - 1); ++x)
      if (x != column || y != row) visit(static_cast<std::uint32_t>(y * width + x));
}

/// Calls with pixels on opposite sides of one, of the eight around it.
template <class F>
void for_opposite_pairs(const ImageSurface& image, std::uint32_t i, const F& visit) {
  const auto width = static_cast<std::uint32_t>(image.receivers.width);
  const bool has_rows = i >= width && image.receivers.size() - i > width;
  const bool has_columns = i % width > 0 && (i + 1) % width > 0;
  if (has_columns) visit(i - 1, i + 1);
  if (has_rows) visit(i - width, i + width);
  if (!has_rows || !has_columns) return;
  visit(i - width - 1, i + width + 1);
  visit(i - width + 1, i + width - 1);
}

/// Of its four neighbors.
int neighbors_on_surface(const ImageSurface& image, std::uint32_t i) {
  int count = 0;
  for_neighbors(image, i, [&](std::uint32_t j) { count += is_one_surface(image, i, j, kSameSurfaceCosine); });
  return count;
}

bool is_at_border(const ImageSurface& image, std::uint32_t i) {
  int pairs = 0;
  for_opposite_pairs(image, i, [&](std::uint32_t, std::uint32_t) { ++pairs; });
  return pairs < 4;
}

float noise_of_mean(int samples) {
  return samples == kAllSamples ? kNoiseOfNine : kNoiseOfOne / std::sqrt(static_cast<float>(samples));
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
  correction_.resize(visibility_.size());
  for (auto* flags : {&denies_, &is_dark_, &is_lit_, &is_asked_, &is_thorough_})
    flags->assign(visibility_.size(), 0);
  sampled_.clear();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, share_.size(), 8192), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      share_[i] = share_of(image_.open[i], visibility_[i]);
  });
}

std::vector<std::uint32_t> Resampler::find_first(std::span<const std::uint32_t> always) const {
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> parts;
  tbb::parallel_for(tbb::blocked_range<int>(0, image_.receivers.height, 16), [&](const auto& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) find_in_row(y, parts.local());
  });
  std::vector<std::uint32_t> out = probe_pixels();
  out.insert(out.end(), always.begin(), always.end());
  for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
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

void Resampler::take_sample(std::uint32_t pixel, const RaySample& sample) {
  sample_[pixel] = sample.visibility;
  correction_[pixel] = sample.visibility - by_entries(pixel);
  denies_[pixel] = sample.denies;
  is_dark_[pixel] = sample.is_dark;
  is_lit_[pixel] = sample.is_lit;
  is_asked_[pixel] = 1;
}

std::vector<std::uint32_t> Resampler::take(std::span<const std::uint32_t> pixels,
                                           std::span<const RaySample> samples) {
  for (std::size_t k = 0; k < pixels.size(); ++k) take_sample(pixels[k], samples[k]);
  sampled_.insert(sampled_.end(), pixels.begin(), pixels.end());
  std::vector<std::uint32_t> next;
  for (const std::uint32_t i : pixels) {
    if (!denies_[i]) continue;
    for_all_around(image_, i, [&](std::uint32_t j) {
      if (is_asked_[j] || !is_one_surface(image_, i, j, kSameSurfaceCosine)) return;
      is_asked_[j] = 1;
      next.push_back(j);
    });
  }
  std::sort(next.begin(), next.end());
  return next;
}

template <class Value>
Resampler::Mean Resampler::mean_of(std::uint32_t i, const Value& value) const {
  const float middle = value(i);
  bool dark = is_dark_[i], lit = is_lit_[i];
  Mean mean{middle, std::abs(correction_[i]), 1};
  float sum = middle, open = image_.open[i];
  for_opposite_pairs(image_, i, [&](std::uint32_t before, std::uint32_t after) {
    if (sample_[before] == kNoSample || sample_[after] == kNoSample) return;
    const float one = value(before), two = value(after);
    if (std::abs(0.5f * (one + two) - middle) > kNoAverage || std::abs(one - two) > kNoAverage) return;
    if (!is_one_surface(image_, i, before, kFlatCosine) || !is_one_surface(image_, i, after, kFlatCosine))
      return;
    sum += one + two;
    open += image_.open[before] + image_.open[after];
    mean.correction += std::abs(correction_[before]) + std::abs(correction_[after]);
    mean.samples += 2;
    dark = dark && is_dark_[before] && is_dark_[after];
    lit = lit && is_lit_[before] && is_lit_[after];
  });
  mean.visibility = open > 0.0f ? sum * image_.open[i] / open : 0.0f;
  mean.correction /= static_cast<float>(mean.samples);
  mean.is_uniform = dark || lit;
  return mean;
}

Resampler::Mean Resampler::mean_sample(std::uint32_t i) const {
  if (is_thorough_[i]) return {sample_[i], 0.0f, kAllSamples, is_dark_[i] || is_lit_[i]};
  Mean by_rays = mean_of(i, [&](std::uint32_t k) { return sample_[k]; });
  if (by_rays.is_uniform && by_rays.samples == kAllSamples) {
    by_rays.visibility = is_dark_[i] ? 0.0f : image_.open[i];
    return by_rays;
  }
  Mean corrected = mean_of(i, [&](std::uint32_t k) { return correction_[k]; });
  corrected.visibility += by_entries(i);
  const float bend = std::abs(corrected.visibility - by_rays.visibility);
  const bool is_near =
      std::abs(corrected.visibility - sample_[i]) < std::abs(by_rays.visibility - sample_[i]);
  Mean mean = is_near && bend > 2.0f * corrected.correction ? corrected : by_rays;
  mean.bend = bend;
  return mean;
}

bool Resampler::is_denied_around(std::uint32_t i) const {
  bool denied = denies_[i];
  for_all_around(image_, i, [&](std::uint32_t k) { denied = denied || denies_[k]; });
  return denied;
}

float Resampler::difference(std::uint32_t i, const Mean& mean) const {
  if (!(is_thorough_[i] ? denies_[i] : is_denied_around(i))) return 0.0f;
  return std::abs(mean.visibility - by_entries(i)) / (kNoiseExplains * noise_of_mean(mean.samples));
}

/// 0 where half of what noise explains is more than the difference, 1 where all of it is less.
float Resampler::weight_of(std::uint32_t i, const Mean& mean) const {
  const float difference = this->difference(i, mean);
  if (mean.is_uniform && mean.samples == kAllSamples) return difference > 0.0f ? 1.0f : 0.0f;
  return std::clamp(2.0f * difference - 1.0f, 0.0f, 1.0f);
}

bool Resampler::is_doubtful(std::uint32_t i) const {
  const Mean mean = mean_sample(i);
  const float weight = weight_of(i, mean);
  if (!(weight > 0.0f)) return false;
  if (mean.samples == kAllSamples) return mean.bend > kMostBend;
  const int neighbors = neighbors_on_surface(image_, i);
  return is_at_border(image_, i) || neighbors == 4 || (neighbors > 1 && weight < 1.0f);
}

void Resampler::sample_thoroughly(const SampleVisibility& sample) {
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> parts;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sampled_.size(), 512), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      if (is_doubtful(sampled_[k])) parts.local().push_back(sampled_[k]);
    }
  });
  std::vector<std::uint32_t> pixels;
  for (const auto& part : parts) pixels.insert(pixels.end(), part.begin(), part.end());
  std::sort(pixels.begin(), pixels.end());
  const std::vector<RaySample> samples = sample(pixels, SamplePoints::kAll);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    take_sample(pixels[k], samples[k]);
    is_thorough_[pixels[k]] = 1;
  }
}

void Resampler::settle() {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sampled_.size(), 512), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const std::uint32_t i = sampled_[k];
      const Mean mean = mean_sample(i);
      visibility_[i] += weight_of(i, mean) * (mean.visibility - visibility_[i]);
    }
  });
}

std::vector<std::uint32_t> isolated_pixels(const ImageSurface& image) {
  std::vector<char> is_isolated(image.receivers.size());
  tbb::parallel_for(std::size_t{0}, is_isolated.size(), [&](std::size_t pixel) {
    const auto i = static_cast<std::uint32_t>(pixel);
    is_isolated[pixel] = image.receivers.is_present(pixel) && neighbors_on_surface(image, i) < 2;
  });
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < is_isolated.size(); ++i)
    if (is_isolated[i]) out.push_back(i);
  return out;
}

std::size_t Resampler::resample(const ImageSurface& image, std::span<const std::uint32_t> always,
                                const SampleVisibility& sample, std::span<float> visibility) {
  image_ = image;
  visibility_ = visibility;
  begin();
  for (std::vector<std::uint32_t> pixels = find_first(always); !pixels.empty();)
    pixels = take(pixels, sample(pixels, SamplePoints::kOwn));
  sample_thoroughly(sample);
  settle();
  return sampled_.size();
}

}  // namespace penumbra::detail
