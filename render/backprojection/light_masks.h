// Method backprojection, step masks: which samples of the light a rectangle along its axes holds.
//
// In: a pattern of samples in the square [-1, 1]² or the unit disk, the same for all receivers. Out: a mask
// of one bit a sample for any rectangle: those of the k leftmost samples, for each k, and of the k lowest,
// are made once, so that a rectangle is found by four searches, two differences and an and.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace penumbra::detail {

using MaskWord = std::uint64_t;

/// Of the light, in units of its half extents.
struct LightRectangle {
  glm::dvec2 low, high;
};

class LightMasks {
 public:
  /// Cost O(samples²) bits.
  LightMasks(bool disk, int samples, std::uint64_t seed);

  std::size_t count() const { return samples_.size(); }
  std::size_t words() const { return words_; }
  std::span<const glm::dvec2> samples() const { return samples_; }
  /// Adds the samples within a rectangle. Cost O(log samples + words).
  void add(const LightRectangle& r, std::span<MaskWord> mask) const;
  /// The mask holds all samples.
  bool is_full(std::span<const MaskWord> mask) const;

 private:
  /// Samples by one coordinate.
  struct Axis {
    std::vector<double> sorted;
    /// Masks of the first k samples, k from 0 on.
    std::vector<MaskWord> prefixes;
  };
  Axis make_axis(int k) const;
  const MaskWord* below(const Axis& axis, double x) const;

  std::vector<glm::dvec2> samples_;
  std::size_t words_;
  Axis x_, y_;
};

}  // namespace penumbra::detail
