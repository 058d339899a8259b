// Receivers: the points at which visibility is asked for.
#pragma once

#include <cstdint>
#include <span>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/mesh/types.h"

namespace penumbra {

/// Arrays that the caller owns, one entry a receiver; those marked optional may be empty. A picture's pixels
/// are one way to make them (SurfaceBuffer).
struct Receivers {
  /// World, scene units.
  std::span<const Vec3> points{};
  /// Optional: unit normals, on the side from which the surface is looked at. What lies below a receiver's
  /// tangent plane is then hidden from it (its horizon). Without normals nothing is below, and visibility is
  /// the unoccluded fraction of the light. In either case the point is where it is: nothing is moved off a
  /// surface.
  std::span<const Vec3> normals{};
  /// Optional: the scene's index of the object on which the point lies; -1: no receiver here, its visibility
  /// is 1.
  std::span<const std::int32_t> objects{};
  /// Optional, with `objects`: the face of that object's mesh on which the point lies. It hides nothing from
  /// the point; nor does any other face in whose plane the point lies, as far as double can tell.
  std::span<const std::uint32_t> faces{};
  /// Where the receivers are a picture's pixels, row by row from the top: its size; else 0.
  int width = 0, height = 0;
  /// Equal numbers other than 0 stand for equal receivers, so that what depends on them alone is kept from
  /// call to call. Take it from new_revision(); 0: nothing is kept.
  std::uint64_t revision = 0;

  std::size_t size() const { return points.size(); }
  bool is_present(std::size_t i) const { return objects.empty() || objects[i] >= 0; }
  bool has_normals() const { return !normals.empty(); }
  bool are_pixels() const { return width > 0; }
};

/// Of the points of those that are present. Cost O(receivers).
Bounds bounds_of_present(const Receivers& receivers);

/// A number that no receivers of this process have yet.
std::uint64_t new_revision();

/// Throws UsageError where arrays have different lengths, numbers are not finite, normals are not of length
/// 1, or a picture's size does not fit. Cost O(receivers).
void require_valid(const Receivers& receivers);

}  // namespace penumbra
