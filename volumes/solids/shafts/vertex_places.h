// Solids: where casters' vertices lie against a shaft, each found once a shaft.
#pragma once

#include <cstdint>
#include <vector>

#include "volumes/solids/shafts/caster_tree.h"

namespace penumbra::detail {

class VertexPlaces {
 public:
  explicit VertexPlaces(std::size_t vertices) : places_(vertices, 0), shaft_of_(vertices, 0) {}

  void begin(const LightShaft& shaft) {
    shaft_ = &shaft;
    ++number_;
  }
  /// True only where an edge lies outside of the shaft; may miss that where neither of its ends is in the
  /// shaft.
  bool are_outside(std::uint32_t a, const Vec3& at_a, std::uint32_t b, const Vec3& at_b) {
    return (place(a, at_a) & place(b, at_b) & ~kInside) != 0;
  }
  /// Of an edge that are_outside tells nothing of: the same, as far as LightShaft::misses can tell.
  bool misses(std::uint32_t a, const Vec3& at_a, std::uint32_t b, const Vec3& at_b) {
    return ((place(a, at_a) | place(b, at_b)) & kInside) == 0 && shaft_->misses(at_a, at_b, at_b);
  }

 private:
  /// Beside the bits of a shaft's sides.
  static constexpr std::uint32_t kInside = std::uint32_t{1} << 31;
  static_assert(LightShaft::kSides + 1 < 31);

  /// As bits: the shaft's sides beyond which a vertex lies, or that it lies in the shaft.
  std::uint32_t place(std::uint32_t v, const Vec3& at) {
    if (shaft_of_[v] != number_) {
      shaft_of_[v] = number_;
      places_[v] = shaft_->sides_beyond(at);
      if (places_[v] == 0 && shaft_->holds(at)) places_[v] = kInside;
    }
    return places_[v];
  }

  const LightShaft* shaft_ = nullptr;
  std::uint32_t number_ = 0;
  std::vector<std::uint32_t> places_;
  std::vector<std::uint32_t> shaft_of_;
};

}  // namespace penumbra::detail
