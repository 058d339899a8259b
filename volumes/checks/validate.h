// Checks of surfaces and volumes, with findings as data. Signs and intersections are exact (CGAL).
//
// Any mesh can be asked whether it is closed, oriented, free of self-intersections, and bounds a volume.
// Umbra and penumbra volumes can also be asked whether the umbra lies in the hard volume from the light's
// center, and that in the penumbra: points are tried, the same for the same seed. Volumes are sums of pieces
// that overlap. Self-intersections of the whole are no fault; of a single piece they are.
#pragma once

#include <optional>
#include <span>

#include "penumbra/volumes/extrude.h"

namespace penumbra {

struct SurfaceFindings {
  std::size_t triangles = 0;
  /// Directed half-edges that are used more often than their opposite. With 0 the surface is combinatorially
  /// closed and oriented.
  std::size_t unmatched_half_edges = 0;
  /// Triangles whose corners are on a line. They are left out of what follows.
  std::vector<std::uint32_t> degenerate;
  /// Pairs of triangles of the whole mesh that cross, touch beyond shared corners and sides, or lie on each
  /// other. Corners at equal positions count as shared.
  std::vector<std::array<std::uint32_t, 2>> self_intersections;
  /// False where there are more self-intersections than were asked for.
  bool all_listed = true;
  /// Parts that are connected by indices.
  std::size_t pieces = 0;
  /// Those that cross themselves.
  std::size_t crossed_pieces = 0;
  /// Those that are closed, do not cross themselves, and bound a volume, outward.
  std::size_t solid_pieces = 0;
  /// Every piece is solid and none meets another. CGAL is asked only where it can answer: its test accepts
  /// some meshes that cross themselves, and may crash on two faces that lie on each other.
  bool bounds_a_volume = false;

  bool closed() const { return unmatched_half_edges == 0; }
};

struct SurfaceCheckOptions {
  /// How many self-intersections are listed. The search stops there.
  std::size_t most_intersections = 1000;
};

/// Checks any set of triangles. Expected cost O(n log n) for n triangles, and the number of listed
/// self-intersections.
SurfaceFindings check_surface(std::span<const Vec3> positions, std::span<const IndexedTriangle> triangles,
                              const SurfaceCheckOptions& options = {});

/// Whether one volume lies in another, as far as the points tell that were tried.
struct ContainmentFindings {
  /// How many were tried: inside the inner volume and the bound, and in front of the light.
  std::size_t points = 0;
  /// How many of them are outside the outer volume, and one of those.
  std::size_t outside = 0;
  std::optional<Vec3> example;
};

struct ValidateOptions {
  SurfaceCheckOptions surface{};
  /// Points to try for each containment.
  std::size_t points = 1000;
  std::uint64_t seed = 1;
  Progress progress{};
};

struct VolumeFindings {
  SurfaceFindings umbra, penumbra;
  ContainmentFindings umbra_in_hard, hard_in_penumbra, umbra_in_penumbra;
  /// Both volumes are closed, and no point is outside.
  bool good() const;
};

/// Checks the volumes of one caster, as build_shadow_volumes makes them with these options. Expected cost O(n
/// log n) for n triangles, and O(points · n). Throws Cancelled.
VolumeFindings validate(const TriangleMesh& mesh, const CircularLight& light, const ShadowMesh& umbra,
                        const ShadowMesh& penumbra, const ExtrudeOptions& extrude,
                        const ValidateOptions& options = {});

}  // namespace penumbra
