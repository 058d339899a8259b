#include "render/backprojection/patch_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace penumbra::detail {
namespace {

/// Accuracy and speed. Nodes seen smaller than this, of the light's half extents, are one patch where their
/// heights differ by less than this, of their height above the receiver.
constexpr double kSmall = 0.1, kNearlyFlat = 0.02;

}  // namespace

PatchTree::PatchTree(const ShadowMap& map, const glm::dvec2& spread, const LightMasks& masks,
                     const PatchOptions& options)
    : map_(map), spread_(spread), masks_(masks), options_(options) {
  for (int below = map.size(); below > 1; below = levels_.back().size) {
    Level level{(below + 1) / 2, {}, {}};
    for (int y = 0; y < level.size; ++y)
      for (int x = 0; x < level.size; ++x) {
        float highest = ShadowMap::kNothing, lowest = 3.4e38f;
        for (int k = 0; k < 4; ++k) {
          const int i = std::min(2 * x + (k & 1), below - 1), j = std::min(2 * y + (k >> 1), below - 1);
          const Level* from = levels_.empty() ? nullptr : &levels_.back();
          highest = std::max(highest, from ? from->highest[from->place(i, j)] : map.at(i, j));
          lowest = std::min(lowest, from ? from->lowest[from->place(i, j)] : map.at(i, j));
        }
        level.highest.push_back(highest);
        level.lowest.push_back(lowest);
      }
    levels_.push_back(std::move(level));
  }
}

/// Whether some texel of a node may be in front of the light: at its greatest height, where it is seen
/// nearest to the light's middle. Level 0 are texels. A stretched texel reaches to its neighbors.
bool PatchTree::reaches_light(const MapReceiver& receiver, const Node& node, float highest) const {
  const double above = highest - receiver.height;
  if (!(above > map_.texel() * options_.bias.constant)) return false;
  const double texels = std::ldexp(1.0, node.level);
  const glm::dvec2 low = map_.corner_of(node.x * texels - 1.0, node.y * texels - 1.0) - receiver.place,
                   high = map_.corner_of((node.x + 1) * texels + 1.0, (node.y + 1) * texels + 1.0) -
                          receiver.place;
  const glm::dvec2 reach = spread_ * above;
  return low.x < reach.x && high.x > -reach.x && low.y < reach.y && high.y > -reach.y;
}

/// The part of the light behind a node whose texels are all higher than the receiver and its plane: where it
/// hides all of the light, or where it is nearly flat and seen small.
std::optional<LightRectangle> PatchTree::as_one_patch(const MapReceiver& receiver, const Node& node) const {
  const Level& level = levels_[static_cast<std::size_t>(node.level - 1)];
  const double highest = level.highest[level.place(node.x, node.y)],
               lowest = level.lowest[level.place(node.x, node.y)];
  const double texels = std::ldexp(1.0, node.level);
  const glm::dvec2 low = map_.corner_of(node.x * texels, node.y * texels) - receiver.place,
                   high = map_.corner_of((node.x + 1) * texels, (node.y + 1) * texels) - receiver.place;
  const double slope = std::min(kSteepest, std::hypot(receiver.rise.x, receiver.rise.y));
  const double plane = std::max(low.x * receiver.rise.x, high.x * receiver.rise.x) +
                       std::max(low.y * receiver.rise.y, high.y * receiver.rise.y);
  const double bias = map_.texel() * (options_.bias.constant + options_.bias.slope * slope);
  if (!(lowest > receiver.height + std::max(0.0, plane) + bias)) return std::nullopt;
  const glm::dvec2 far = spread_ * (highest - receiver.height), near = spread_ * (lowest - receiver.height);
  const bool covers =
      options_.fill_gaps && low.x <= -far.x && low.y <= -far.y && high.x >= far.x && high.y >= far.y;
  const bool is_flat = highest - lowest <= kNearlyFlat * (lowest - receiver.height);
  const bool is_small = high.x - low.x <= kSmall * near.x && high.y - low.y <= kSmall * near.y;
  if (!covers && !(is_flat && is_small)) return std::nullopt;
  // What its texels hide at the least height and at the greatest, so that no gap is left between neighbors.
  return LightRectangle{glm::min(low / far, low / near), glm::max(high / far, high / near)};
}

/// Than the receiver, and than its plane.
bool PatchTree::is_higher(const MapReceiver& receiver, int x, int y, double height) const {
  const glm::dvec2 off = map_.center_of(x, y) - receiver.place;
  const double slope = std::min(kSteepest, std::hypot(receiver.rise.x, receiver.rise.y));
  const double bias = map_.texel() * (options_.bias.constant + options_.bias.slope * slope);
  const double plane = receiver.rise.x * off.x + receiver.rise.y * off.y;
  return height > receiver.height + std::max(0.0, plane) + bias;
}

LightRectangle PatchTree::part_of_light(const MapReceiver& receiver, int x, int y) const {
  const glm::dvec2 low = map_.corner_of(x, y) - receiver.place,
                   high = map_.corner_of(x + 1, y + 1) - receiver.place;
  const auto scale = [&](double height) { return 1.0 / (spread_ * (height - receiver.height)); };
  const glm::dvec2 own = scale(map_.at(x, y));
  LightRectangle out{low * own, high * own};
  if (!options_.fill_gaps) return out;
  if (x > 0 && is_higher(receiver, x - 1, y, map_.at(x - 1, y))) {
    const double border = low.x * scale(map_.at(x - 1, y)).x;
    out.low.x = std::min(out.low.x, border), out.high.x = std::max(out.high.x, border);
  }
  if (y > 0 && is_higher(receiver, x, y - 1, map_.at(x, y - 1))) {
    const double border = low.y * scale(map_.at(x, y - 1)).y;
    out.low.y = std::min(out.low.y, border), out.high.y = std::max(out.high.y, border);
  }
  return out;
}

std::size_t PatchTree::hide(const MapReceiver& receiver, std::span<MaskWord> mask) const {
  // Depth first: three nodes a level wait, and one more.
  std::array<Node, 64> stack;
  std::size_t waiting = 0, patches = 0;
  stack[waiting++] = {static_cast<int>(levels_.size()), 0, 0};
  while (waiting > 0) {
    const Node node = stack[--waiting];
    if (node.level == 0) {
      const float height = map_.at(node.x, node.y);
      if (!reaches_light(receiver, node, height) || !is_higher(receiver, node.x, node.y, height)) continue;
      masks_.add(part_of_light(receiver, node.x, node.y), mask);
      ++patches;
      continue;
    }
    const Level& level = levels_[static_cast<std::size_t>(node.level - 1)];
    if (!reaches_light(receiver, node, level.highest[level.place(node.x, node.y)])) continue;
    if (const auto patch = as_one_patch(receiver, node)) {
      masks_.add(*patch, mask);
      ++patches;
      continue;
    }
    if (patches > 0 && masks_.is_full(mask)) return patches;
    const int below = node.level == 1 ? map_.size() : levels_[static_cast<std::size_t>(node.level - 2)].size;
    for (int k = 3; k >= 0; --k) {
      const Node child{node.level - 1, 2 * node.x + (k & 1), 2 * node.y + (k >> 1)};
      if (child.x < below && child.y < below) stack[waiting++] = child;
    }
  }
  return patches;
}

}  // namespace penumbra::detail
