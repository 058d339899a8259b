// Pixels whose visibility contradicts their neighbours'.
//
// In a D-buffer a texel holds one entry a kind. Where two boundaries compete, receivers side by side read
// different ones, and their visibilities differ by a step. But visibility is continuous on a surface, except
// where something touches it; so a step says where entries are wrong, and what rays say of its pixels is
// carried on from neighbour to neighbour until it agrees with what entries say.
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

/// Visibility of the given pixels, in their order.
using AskVisibility = std::function<std::vector<float>(std::span<const std::uint32_t>)>;

/// More than this between neighbours is a step, and more than this between an answer and what the entries say
/// makes the answer count; less is noise of the answer or the slope of a narrow penumbra.
inline constexpr float kVisibilityStep = 0.1f;

/// Asks about both sides of every step between neighbours on one surface, and about the neighbours of every
/// pixel that an answer changed. Returns how many pixels were asked, each once; all of them see a surface.
/// Cost O(pixels) and the answers, on all cores.
std::size_t ask_beside_steps(const ImageSurface& image, const AskVisibility& ask,
                             std::vector<float>& visibility);

}  // namespace penumbra::detail
