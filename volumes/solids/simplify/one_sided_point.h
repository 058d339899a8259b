// Solids: where the vertex goes that replaces an edge, so that the surface moves to one side only.
//
// The triangles around both ends are replaced by triangles to the new vertex. What lies between are
// tetrahedra, one on each old triangle. If the new vertex is on no triangle's wrong side, all of them are
// added to the solid (or all taken away): P. Sander et al., "Silhouette clipping" (2000), section 4,
// progressive hulls. Among the points allowed, the one with the least sum of squared distances from the old
// planes is taken (M. Garland, P. Heckbert, 1997): a quadratic program.
#pragma once

#include <optional>
#include <span>

#include "penumbra/mesh/types.h"

namespace penumbra::detail {

/// Sum of weighted squared distances from planes, about a point of reference that the caller keeps.
struct Quadric {
  /// Σ w n nᵀ: xx, xy, xz, yy, yz, zz.
  std::array<double, 6> matrix{};
  Vec3 linear{0.0};  ///< Σ w n (n · p)
  double constant = 0.0;

  void add_plane(const Vec3& normal, const Vec3& point, double weight);
  Quadric& operator+=(const Quadric& other);
  double at(const Vec3& x) const;
};

/// normal · x ≤ offset, with a unit normal.
struct PlaneLimit {
  Vec3 normal;
  double offset;
};

struct PlacementOptions {
  /// Coordinates that must not change from those of the start.
  std::array<bool, 3> fixed{};
  /// How far a point may lie beyond a half-space for rounding, and how far inside it is put where the least
  /// lies beyond.
  double rounding = 0.0, margin = 0.0;
};

/// The point of all limits with the least quadric, near `start` where that leaves a choice. Nothing where
/// none is found.
std::optional<Vec3> place_one_sided(const Quadric& quadric, std::span<const PlaneLimit> limits,
                                    const Vec3& start, const PlacementOptions& options);

}  // namespace penumbra::detail
