// Solids: umbra, penumbra, or the region in which at most a given fraction of a light is seen, as one clean
// surface each.
//
// In: casters, a circular light near or distant, a bound. Out: a closed, oriented two-manifold without
// self-intersections, which other tools can slice, print, subtract and measure.
//
// Points of a grid are judged by the one call for visibility (visibility.h). The surface between those inside
// and those outside lies on the grid's edges (volumes/solids/). Each triangle of an umbra is then moved
// inward until it is proved to be wholly in umbra, or no point that is tried a twentieth of the grid's
// spacing outside of it sees light; each triangle of a penumbra is moved outward until it is proved to be
// wholly lit. What that says of the inside is told in volumes/solids/solid_mesher.h.
#pragma once

#include "penumbra/mesh/stage_clock.h"
#include "penumbra/render/visibility.h"
#include "penumbra/volumes/shadow_mesh.h"

namespace penumbra {

/// What a solid is made of: points that see a certain fraction O of the light.
struct ShadowLevel {
  enum class Kind : std::uint8_t {
    kUmbra,     ///< O = 0
    kPenumbra,  ///< O < 1
    kFraction,  ///< O ≤ fraction
  };
  Kind kind = Kind::kPenumbra;
  double fraction = 0.5;
};

struct SolidOptions {
  /// Scene units; 0: a hundredth of the diagonal of the casters' box. Detail of this size is kept.
  double tolerance = 0.0;
  /// The solid ends there. It must hold the casters. Empty: their box, grown by its diagonal on all sides.
  Bounds bound{};
  /// Leaves out the bodies of casters, as far as they are closed. Bodies thinner than a grid's cell may stay.
  /// The guarantee is kWithin.
  bool hollow = false;
  /// Written to tags.
  std::uint32_t object = 0;
  Progress progress{};
};

struct ShadowSolid {
  /// Kinds are kSolid and, where it is cut off by the bound, kFarCap. The guarantee is kCertified where every
  /// triangle is proved, else kWithin.
  ShadowMesh mesh;
  /// Scene units³ and scene units².
  double volume = 0.0, area = 0.0;
  /// Triangles that are proved to be on the safe side, of those that are no far caps.
  std::size_t proved = 0, to_prove = 0;
  /// One a triangle: it is proved. Where the umbra is that of one convex body, what lies just inside of it
  /// is.
  std::vector<char> is_proved;
  /// Of the surface before it was simplified.
  std::size_t grid_triangles = 0;
  std::size_t grid_points = 0, evaluations = 0;
  /// Scene units: as it was used, and the distance of grid points.
  double tolerance = 0.0, spacing = 0.0;
  StageTimes stages;
};

/// Surface by marching tetrahedra; simplified on one side, as progressive hulls are (P. Sander et al.,
/// "Silhouette clipping", 2000, section 3). Cost: the grid and one call for visibility at each of its points
/// near the surface, and some twenty points a triangle, several times where an umbra's are moved; on all
/// threads. At the usual tolerance 1 s for the umbra of a bunny, 22 s for that of an armadillo under a light
/// whose radius is a sixth of its diagonal, on two cores; triangles grow like 1 / tolerance².
///
/// The bodies of the casters belong to umbra and penumbra, unless they are left out. What is on the light's
/// plane or behind it does not. Deterministic. Throws UsageError for a rectangle, options outside their
/// domain, or a tolerance so small that the grid does not fit; Cancelled.
ShadowSolid extrude_solid(const Casters& casters, const LightShape& light, const ShadowLevel& level,
                          const SolidOptions& options = {});

}  // namespace penumbra
