#include "render/d_buffer/visibility_steps.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "render/support/vector_clones.h"

namespace penumbra::detail {
namespace {

constexpr float kTurned = 0.9f;  // cosine between normals of what still counts as one surface
constexpr float kFlat = 0.998f;  // the same for answers that are put together
constexpr float kApart = 0.5f;   // height above the neighbour's plane over the distance
constexpr float kDoubt = 2.0f;   // so many times the answers' noise is no longer explained by it
constexpr float kBend = 0.3f;  // between answers on either side of a pixel, or at it, that no noise explains

/// Without a branch in the loop, so that it vectorises.
PENUMBRA_VECTOR_CLONES
bool any_apart(const float* a, const float* b, std::uint32_t count) {
  int any = 0;
  for (std::uint32_t i = 0; i < count; ++i) any |= std::abs(a[i] - b[i]) > kVisibilityStep;
  return any != 0;
}

template <class F>
void for_neighbours(const ImageSurface& image, std::uint32_t i, const F& visit) {
  const auto width = static_cast<std::uint32_t>(image.width);
  const std::uint32_t x = i % width;
  if (x > 0) visit(i - 1);
  if (x + 1 < width) visit(i + 1);
  if (i >= width) visit(i - width);
  if (i + width < image.positions.size()) visit(i + width);
}

bool is_one_surface(const ImageSurface& image, std::uint32_t i, std::uint32_t j, float turned) {
  if (image.positions[i].w == 0.0f || image.positions[j].w == 0.0f) return false;
  const glm::vec3 n(image.normals[i]), way(image.positions[j] - image.positions[i]);
  return glm::dot(n, glm::vec3(image.normals[j])) > turned &&
         std::abs(glm::dot(n, way)) <= kApart * glm::length(way);
}

constexpr float kNone = -1.0f;  // no answer

/// What the mean of some answers errs by, as root mean square where one edge crosses the disk. That of all
/// nine errs by less than independent answers would, since their patterns complement each other
/// (CenterRays::sampled_visibility).
float noise_of_mean(int answers) {
  return answers == 9 ? 0.007f : 0.037f / std::sqrt(static_cast<float>(answers));
}

/// Of what is above the horizon; a sliver of the disk counts as seen.
float share_of(float open, float visibility) {
  return open > 0.05f ? visibility / open : 1.0f;
}

/// The next one on the line from i through j; j at the image's border.
std::uint32_t beyond(const ImageSurface& image, std::uint32_t i, std::uint32_t j) {
  const auto width = static_cast<std::uint32_t>(image.width);
  const std::uint32_t next = 2 * j - i;  // wraps to a great number above the first row
  const std::uint32_t column = j % width;
  const bool sideways = j / width == i / width;
  return next >= image.positions.size() || (sideways && (column == 0 || column + 1 == width)) ? j : next;
}

}  // namespace

void VisibilitySteps::begin() {
  share_.resize(visibility_.size());
  answer_.assign(visibility_.size(), kNone);
  known_.assign(visibility_.size(), kNotAsked);
  asked_.clear();
  before_ = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, share_.size(), 8192), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      share_[i] = share_of(image_.open[i], visibility_[i]);
  });
}

std::vector<std::uint32_t> VisibilitySteps::find(std::span<const std::uint32_t> anyway,
                                                 std::span<const std::uint32_t> suspects) {
  tbb::enumerable_thread_specific<std::vector<std::uint32_t>> parts;
  tbb::parallel_for(tbb::blocked_range<int>(0, image_.height, 16), [&](const auto& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) find_in_row(y, parts.local());
  });
  std::vector<std::uint32_t> out(anyway.begin(), anyway.end());
  for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  for (const std::uint32_t i : out) known_[i] = kDoubtful;
  std::vector<std::uint32_t> others = sentinels();
  others.insert(others.end(), suspects.begin(), suspects.end());
  for (const std::uint32_t i : others) {
    if (known_[i] != kNotAsked) continue;
    known_[i] = kSentinel;
    out.push_back(i);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<std::uint32_t> VisibilitySteps::sentinels() const {
  constexpr int kInShadow = 8, kInLight = 16;
  std::vector<std::uint32_t> out;
  for (int y = kInShadow / 2; y < image_.height; y += kInShadow)
    for (int x = kInShadow / 2; x < image_.width; x += kInShadow) {
      const auto i = static_cast<std::uint32_t>(y * image_.width + x);
      const bool wanted =
          visibility_[i] < image_.open[i] || (x % kInLight < kInShadow && y % kInLight < kInShadow);
      if (wanted && image_.positions[i].w != 0.0f && image_.open[i] > 0.0f) out.push_back(i);
    }
  return out;
}

void VisibilitySteps::find_in_row(int y, std::vector<std::uint32_t>& out) const {
  const auto width = static_cast<std::uint32_t>(image_.width);
  const std::uint32_t begin = static_cast<std::uint32_t>(y) * width;
  find_between(begin, width - 1, 1, out);
  if (y + 1 < image_.height) find_between(begin, width, width, out);
}

void VisibilitySteps::find_between(std::uint32_t begin, std::uint32_t count, std::uint32_t apart,
                                   std::vector<std::uint32_t>& out) const {
  constexpr std::uint32_t kBlock = 64;
  for (std::uint32_t i = begin, end = begin + count; i < end; i += kBlock) {
    const std::uint32_t n = std::min(kBlock, end - i);
    if (!any_apart(&share_[i], &share_[i + apart], n)) continue;
    for (std::uint32_t k = i; k < i + n; ++k)
      if (is_step(k, k + apart)) out.insert(out.end(), {k, k + apart});
  }
}

bool VisibilitySteps::is_step(std::uint32_t i, std::uint32_t j) const {
  const float step = share_[j] - share_[i];
  if (!(std::abs(step) > kVisibilityStep)) return false;
  const float before = share_[i] - share_[beyond(image_, j, i)];
  const float after = share_[beyond(image_, i, j)] - share_[j];
  if (!(std::abs(step - before) > kVisibilityStep && std::abs(step - after) > kVisibilityStep)) return false;
  return is_one_surface(image_, i, j, kTurned);
}

std::vector<std::uint32_t> VisibilitySteps::take(std::span<const std::uint32_t> pixels,
                                                 std::span<const float> said) {
  for (std::size_t k = 0; k < pixels.size(); ++k) answer_[pixels[k]] = said[k];
  const std::size_t again = before_;
  before_ = asked_.size();
  asked_.insert(asked_.end(), pixels.begin(), pixels.end());
  differs_.resize(asked_.size() - again);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, differs_.size(), 256), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k)
      differs_[k] = difference(asked_[again + k], mean_answer(asked_[again + k])) > 1.0f;
  });
  std::vector<std::uint32_t> next;
  for (std::size_t k = 0; k < differs_.size(); ++k) {
    if (!differs_[k]) continue;
    const std::uint32_t i = asked_[again + k];
    for_neighbours(image_, i, [&](std::uint32_t j) {
      if (known_[j] != kNotAsked || !is_one_surface(image_, i, j, kTurned)) return;
      known_[j] = known_[i];
      next.push_back(j);
    });
  }
  return next;
}

VisibilitySteps::Mean VisibilitySteps::mean_answer(std::uint32_t i) const {
  const auto width = static_cast<std::uint32_t>(image_.width);
  if (i < width || i + width >= answer_.size() || i % width == 0 || i % width == width - 1)
    return {answer_[i], visibility_of(i), 1};
  float seen = answer_[i], open = image_.open[i], said = visibility_of(i);
  int answers = 1;
  for (const std::uint32_t d : {1u, width - 1, width, width + 1}) {
    if (answer_[i - d] == kNone || answer_[i + d] == kNone) continue;
    if (!is_one_surface(image_, i, i - d, kFlat) || !is_one_surface(image_, i, i + d, kFlat)) continue;
    const float before = answer_[i - d], after = answer_[i + d];
    if (std::abs(0.5f * (before + after) - answer_[i]) > kBend || std::abs(before - after) > kBend) continue;
    seen += answer_[i - d] + answer_[i + d];
    open += image_.open[i - d] + image_.open[i + d];
    said += visibility_of(i - d) + visibility_of(i + d);
    answers += 2;
  }
  const float scale = open > 0.0f ? image_.open[i] / open : 0.0f;
  return {scale * seen, scale * said, answers};
}

float VisibilitySteps::difference(std::uint32_t i, const Mean& mean) const {
  float most = std::abs(mean.visibility - visibility_of(i));
  if (known_[i] == kSentinel) most = std::min(most, std::abs(mean.visibility - mean.by_entries));
  return most / (kDoubt * noise_of_mean(mean.answers));
}

void VisibilitySteps::settle() {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, asked_.size(), 512), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      const std::uint32_t i = asked_[k];
      const Mean mean = mean_answer(i);
      // Of a few answers that nothing but a sentinel asked for, what differs is noise more often than not.
      const float belief = mean.answers < 9 && known_[i] == kSentinel ? 0.5f : 1.0f;
      const float weight = std::clamp(2.0f * belief * difference(i, mean) - 1.0f, 0.0f, 1.0f);
      visibility_[i] += weight * (mean.visibility - visibility_[i]);
    }
  });
}

std::vector<std::uint32_t> lonely_pixels(const ImageSurface& image) {
  std::vector<char> lonely(image.positions.size());
  tbb::parallel_for(std::size_t{0}, lonely.size(), [&](std::size_t pixel) {
    const auto i = static_cast<std::uint32_t>(pixel);
    int together = 0;
    for_neighbours(image, i, [&](std::uint32_t j) { together += is_one_surface(image, i, j, kTurned); });
    lonely[pixel] = image.positions[pixel].w != 0.0f && together < 2;
  });
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < lonely.size(); ++i)
    if (lonely[i]) out.push_back(i);
  return out;
}

std::size_t VisibilitySteps::ask(const ImageSurface& image, std::span<const std::uint32_t> anyway,
                                 std::span<const std::uint32_t> suspects, const AskVisibility& ask,
                                 std::span<float> visibility) {
  image_ = image;
  visibility_ = visibility;
  begin();
  for (std::vector<std::uint32_t> pixels = find(anyway, suspects); !pixels.empty();)
    pixels = take(pixels, ask(pixels));
  settle();
  return asked_.size();
}

}  // namespace penumbra::detail
