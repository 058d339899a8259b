// Receivers: the points at which visibility is asked for.
#pragma once

#include <cstdint>
#include <span>

#include "penumbra/mesh/types.h"

namespace penumbra {

/// Arrays that the caller owns, one entry a receiver; those marked optional may be empty. A picture's pixels
/// are one way to make them (SurfaceBuffer).
struct Receivers {
  /// World, scene units.
  std::span<const Vec3> points{};
  /// Optional: unit normals. What lies below a receiver's tangent plane is then hidden from it (its horizon).
  /// Without normals nothing is: visibility is the unoccluded fraction of the light.
  std::span<const Vec3> normals{};
  /// Optional: the scene's index of the object on which the point lies; -1: no receiver here, its visibility
  /// is 1.
  std::span<const std::int32_t> objects{};
  /// Optional, with `objects`: the face of that object's mesh on which the point lies.
  std::span<const std::uint32_t> faces{};
  /// Where the receivers are a picture's pixels, row by row from the top: its size; else 0.
  int width = 0, height = 0;
  /// Equal numbers other than 0 stand for equal receivers, so that what depends on them alone is kept.
  std::uint64_t revision = 0;

  std::size_t size() const { return points.size(); }
  bool is_present(std::size_t i) const { return objects.empty() || objects[i] >= 0; }
  bool has_normals() const { return !normals.empty(); }
  bool are_pixels() const { return width > 0; }
};

/// Throws UsageError where arrays have different lengths or numbers are not finite. Cost O(receivers).
void require_valid(const Receivers& receivers);

}  // namespace penumbra
