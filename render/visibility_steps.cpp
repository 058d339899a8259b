#include "render/visibility_steps.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace penumbra::detail {
namespace {

constexpr float kTurned = 0.9f;  // cosine between normals of what still counts as one surface
constexpr float kApart = 0.5f;   // height above the neighbour's plane over the distance

class Steps {
 public:
  Steps(const ImageSurface& image, std::vector<float>& visibility)
      : image_(image), visibility_(visibility), share_(visibility.size()), known_(visibility.size(), 0) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, share_.size(), 8192), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) share_[i] = share_of(i);
    });
  }

  /// Pixels on either side of a step, in the image's order.
  std::vector<std::uint32_t> find() {
    tbb::enumerable_thread_specific<std::vector<std::uint32_t>> parts;
    tbb::parallel_for(tbb::blocked_range<int>(0, image_.height, 16), [&](const auto& rows) {
      std::vector<std::uint32_t>& part = parts.local();
      const auto begin = static_cast<std::uint32_t>(rows.begin() * image_.width);
      const auto end = static_cast<std::uint32_t>(rows.end() * image_.width);
      for (std::uint32_t i = begin; i < end; ++i)
        if (is_beside_step(i)) part.push_back(i);
    });
    std::vector<std::uint32_t> out;
    for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
    std::sort(out.begin(), out.end());
    for (const std::uint32_t i : out) known_[i] = 1;
    return out;
  }

  /// Takes what was said of the pixels; returns those to be asked next.
  std::vector<std::uint32_t> take(std::span<const std::uint32_t> pixels, std::span<const float> said) {
    std::vector<std::uint32_t> changed, next;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      float& visibility = visibility_[pixels[k]];
      if (!(std::abs(visibility - said[k]) > kVisibilityStep)) continue;
      visibility = said[k];
      share_[pixels[k]] = share_of(pixels[k]);
      changed.push_back(pixels[k]);
    }
    for (const std::uint32_t i : changed) {
      for_neighbours(i, [&](std::uint32_t j) {
        if (known_[j] || !is_one_surface(i, j)) return;
        known_[j] = 1;
        next.push_back(j);
      });
    }
    return next;
  }

 private:
  /// Of what is above the horizon; a sliver of the disk counts as seen.
  float share_of(std::size_t i) const {
    return image_.open[i] > 0.05f ? visibility_[i] / image_.open[i] : 1.0f;
  }

  template <class F>
  void for_neighbours(std::uint32_t i, const F& visit) const {
    const auto width = static_cast<std::uint32_t>(image_.width);
    const std::uint32_t x = i % width;
    if (x > 0) visit(i - 1);
    if (x + 1 < width) visit(i + 1);
    if (i >= width) visit(i - width);
    if (i + width < visibility_.size()) visit(i + width);
  }

  bool is_beside_step(std::uint32_t i) const {
    bool any = false;
    for_neighbours(i, [&](std::uint32_t j) { any = any || is_step(i, j); });
    return any;
  }

  /// The next one on the line from i through j; j at the image's border.
  std::uint32_t beyond(std::uint32_t i, std::uint32_t j) const {
    const auto width = static_cast<std::uint32_t>(image_.width);
    const std::uint32_t next = 2 * j - i;  // wraps to a great number above the first row
    const std::uint32_t column = j % width;
    const bool sideways = j / width == i / width;
    return next >= visibility_.size() || (sideways && (column == 0 || column + 1 == width)) ? j : next;
  }

  bool is_step(std::uint32_t i, std::uint32_t j) const {
    const float step = share_[j] - share_[i];
    if (!(std::abs(step) > kVisibilityStep)) return false;
    const float before = share_[i] - share_[beyond(j, i)], after = share_[beyond(i, j)] - share_[j];
    if (!(std::abs(step - before) > kVisibilityStep && std::abs(step - after) > kVisibilityStep))
      return false;
    return is_one_surface(i, j);
  }

  bool is_one_surface(std::uint32_t i, std::uint32_t j) const {
    if (image_.positions[i].w == 0.0f || image_.positions[j].w == 0.0f) return false;
    const glm::vec3 n(image_.normals[i]), way(image_.positions[j] - image_.positions[i]);
    return glm::dot(n, glm::vec3(image_.normals[j])) > kTurned &&
           std::abs(glm::dot(n, way)) <= kApart * glm::length(way);
  }

  const ImageSurface& image_;
  std::vector<float>& visibility_;
  std::vector<float> share_;
  std::vector<char> known_;  ///< asked or about to be
};

}  // namespace

std::size_t ask_beside_steps(const ImageSurface& image, const AskVisibility& ask,
                             std::vector<float>& visibility) {
  Steps steps(image, visibility);
  std::size_t count = 0;
  for (std::vector<std::uint32_t> pixels = steps.find(); !pixels.empty();) {
    count += pixels.size();
    pixels = steps.take(pixels, ask(pixels));
  }
  return count;
}

}  // namespace penumbra::detail
