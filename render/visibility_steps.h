// Pixels whose visibility contradicts their neighbours'.
//
// In a D-buffer a texel holds one entry a kind. Where two boundaries compete, receivers side by side read
// different ones, and their visibilities differ by a step. But visibility is continuous on a surface, except
// where something touches it; so a step says where entries are wrong, and what rays say of its pixels is
// carried on from neighbour to neighbour until it agrees with what entries say. Neighbours ask different
// points of the light, so that the mean of their answers has little noise (interleaved sampling, A. Keller
// and W. Heidrich 2001).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace penumbra::detail {

/// An image's surface; the fourth number of a position is 0 where nothing is seen. `open` is the visibility
/// that the horizon alone leaves: only what casters do to it is compared, since it jumps where normals do.
struct ImageSurface {
  int width, height;
  std::span<const glm::vec4> positions, normals;
  std::span<const float> open;
};

/// Visibility of the given pixels, in their order; what neighbours' answers err by is independent.
using AskVisibility = std::function<std::vector<float>(std::span<const std::uint32_t>)>;

/// More than this between neighbours is a step; less may be the slope of a narrow penumbra.
inline constexpr float kVisibilityStep = 0.1f;

/// Pixels that see a surface which at most one of their four neighbours sees too, ascending: leaves and
/// needles, where wrong entries contradict nothing. Cost O(pixels), on all cores.
std::vector<std::uint32_t> lonely_pixels(const ImageSurface& image);

/// Where rays are asked, and what becomes of their answers. Keeps its memory from one image to the next.
class VisibilitySteps {
 public:
  /// Asks about the pixels in `anyway` (ascending), about both sides of every step between neighbours on one
  /// surface, and about the neighbours of every pixel where the answers differ from `visibility` by more than
  /// their noise. Where they do, the mean of those on flat ground around a pixel takes its place, in opposite
  /// pairs so that a slope does not shift it; where they differ by less, only in part, so that no edge shows.
  /// Returns how many pixels were asked, each once; all of them see a surface. Cost O(pixels) and the
  /// answers, on all cores.
  std::size_t ask(const ImageSurface& image, std::span<const std::uint32_t> anyway, const AskVisibility& ask,
                  std::vector<float>& visibility);

 private:
  std::vector<float> share_, answer_;
  std::vector<char> known_;
  std::vector<std::uint32_t> asked_;
};

}  // namespace penumbra::detail
