// Solids: fewer triangles, moved to one side only.
#pragma once

#include <span>
#include <vector>

#include "penumbra/mesh/progress.h"
#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

struct SimplifyOptions {
  enum class Side : std::uint8_t { kInward, kOutward, kEither };
  Side side = Side::kOutward;
  /// No point moves farther than this, scene units.
  double tolerance = 0.0;
  /// Holds the surface. Vertices on its sides stay on them, and none leaves it.
  Bounds box{};
  /// A length that is small against all detail, such as the distance of grid points.
  double spacing = 0.0;
  Progress progress{};
};

struct IndexedSurface {
  std::vector<Vec3> positions;
  std::vector<IndexedTriangle> triangles;
};

/// Collapses edges of a closed, oriented two-manifold without self-intersections, those first that change its
/// volume least. It stays one. With kInward the result lies inside of the surface that was given, but for
/// rounding; with kOutward outside. Throws Cancelled. Cost O(n log n).
IndexedSurface simplify(IndexedSurface surface, const SimplifyOptions& options);

}  // namespace penumbra::detail
