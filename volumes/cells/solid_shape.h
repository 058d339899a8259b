// Whether a component is a convex or a star-shaped solid, decided exactly.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

enum class SolidKind { kOther, kStarShaped, kConvex };

struct SolidShape {
  SolidKind kind = SolidKind::kOther;
  /// Four points whose average is strictly below every face. Meaningless for kOther.
  std::array<Vec3, 4> inside{};
};

/// After Mehlhorn et al., "Checking geometric programs or verification of geometric structures" (1999). A
/// closed surface that bends inward at no edge bounds a convex body iff some point is strictly below all of
/// its faces, and a ray from there through the middle of one face meets no other face. Without the condition
/// on edges the body is star-shaped about the point. The only point that is tried is the mean of the
/// vertices, so a star-shaped solid may be called kOther. Nothing is below a face without area, so components
/// with one are kOther. Cost O(faces).
SolidShape shape_of_solid(const TriangleMesh& mesh, const Component& component);

}  // namespace penumbra::detail
