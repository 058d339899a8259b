// Checks of what extrusion produced, as data. Part of penumbra::checks: exact intersections and CGAL's test
// for bounded volumes.
//
// Any mesh can be asked whether it is closed, oriented, free of self-intersections, and bounds a volume;
// umbra and penumbra volumes also whether umbra ⊂ hard volume from the light's center ⊂ penumbra, at seeded
// points. Volumes are sums of pieces that overlap, so self-intersections of the whole are no fault; of a
// single piece they are.
#pragma once

#include <optional>
#include <span>

#include "penumbra/volumes/extrude.h"

namespace penumbra {

struct SurfaceFindings {
  std::size_t triangles = 0;
  /// Directed half-edges used more often than their opposite: 0 means combinatorially closed and oriented.
  std::size_t unmatched_half_edges = 0;
  std::vector<std::uint32_t>
      degenerate;  ///< triangles whose corners are on a line (left out of what follows)
  /// Pairs of triangles that cross, touch beyond shared corners and sides, or lie on each other, in the whole
  /// mesh. Corners at equal positions count as shared.
  std::vector<std::array<std::uint32_t, 2>> self_intersections;
  bool all_listed = true;          ///< false: there are more self-intersections than were asked for
  std::size_t pieces = 0;          ///< connected parts (by indices)
  std::size_t crossed_pieces = 0;  ///< that cross themselves
  std::size_t solid_pieces = 0;    ///< closed, not crossed and bounding a volume, outward

  bool closed() const { return unmatched_half_edges == 0; }
  /// Every piece is solid and none meets another. Asked of CGAL only where it can answer: its test accepts
  /// some meshes that cross themselves and may crash on two faces that lie on each other.
  bool bounds_a_volume = false;
};

struct SurfaceCheckOptions {
  std::size_t most_intersections = 1000;  ///< listed; the search stops there
};

/// Expected cost O(n log n) for n triangles, and the listed self-intersections.
SurfaceFindings check_surface(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                              const SurfaceCheckOptions& options = {});

struct ContainmentFindings {
  std::size_t points = 0;   ///< tried: seeded, inside of the inner volume, the bound, and the light's front
  std::size_t outside = 0;  ///< of them, outside of the outer volume
  std::optional<Vec3> example;  ///< one of those
};

struct ValidateOptions {
  SurfaceCheckOptions surface;
  std::size_t points = 1000;  ///< tried at each containment
  std::uint64_t seed = 1;
};

struct VolumeFindings {
  SurfaceFindings umbra, penumbra;
  ContainmentFindings umbra_in_hard, hard_in_penumbra, umbra_in_penumbra;
  /// Both volumes closed, and no point outside.
  bool good() const;
};

/// Checks the volumes of one caster, as build_shadow_volumes makes them with these options.
/// Expected cost O(n log n) for n triangles, and O(points · n).
VolumeFindings validate(const TriangleMesh& mesh, const DiskLight& light, const ShadowMesh& umbra,
                        const ShadowMesh& penumbra, const ExtrudeOptions& extrude,
                        const ValidateOptions& options = {});

}  // namespace penumbra
