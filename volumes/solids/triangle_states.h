// Solids: what is known of the triangles of a surface, for the next surface on the same grid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "volumes/solids/grid_surface.h"
#include "volumes/solids/triangle_points.h"

namespace penumbra::detail {

/// One a triangle: the parts of it that are known to have no fault, as TrianglePoints::Known has them, and
/// whether it could not be proved. Of a triangle that has no state yet, nothing is known.
class TriangleStates {
 public:
  static constexpr std::uint8_t kUnproved = 128;

  void carry_to(const GridSurface& surface) {
    std::vector<std::uint8_t> next(surface.names.size(), 0);
    std::size_t old = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      while (old < names_.size() && names_[old] < surface.names[i]) ++old;
      if (old < names_.size() && names_[old] == surface.names[i]) next[i] = states_[old];
    }
    names_ = surface.names;
    states_ = std::move(next);
  }
  std::uint8_t of(std::size_t i) const { return states_[i]; }
  bool is_unproved(std::size_t i) const { return (states_[i] & kUnproved) != 0; }
  /// Some point had a fault, or was not tried.
  bool is_open(std::size_t i) const {
    return (states_[i] & TrianglePoints::kWhole) != TrianglePoints::kWhole;
  }
  void set(std::size_t i, bool proved, std::uint8_t parts) {
    states_[i] = proved ? TrianglePoints::kWhole : static_cast<std::uint8_t>(kUnproved | parts);
  }
  void set_parts(std::size_t i, std::uint8_t parts) {
    states_[i] = static_cast<std::uint8_t>((states_[i] & kUnproved) | parts);
  }
  /// Nothing is known any more of the points of triangles that could not be proved.
  void forget_points() {
    for (std::uint8_t& s : states_)
      if (s & kUnproved) s = kUnproved;
  }

 private:
  std::vector<std::uint64_t> names_;
  std::vector<std::uint8_t> states_;
};

}  // namespace penumbra::detail
