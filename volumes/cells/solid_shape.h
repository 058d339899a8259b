// Whether a component is a convex or a star-shaped solid, exactly.
#pragma once

#include "penumbra/mesh/triangle_mesh.h"

namespace penumbra::detail {

enum class SolidKind { kOther, kStarShaped, kConvex };

struct SolidShape {
  SolidKind kind = SolidKind::kOther;
  std::array<Vec3, 4> inside{};  ///< their average is strictly below every face; meaningless for kOther
};

/// After Mehlhorn et al., "Checking geometric programs or verification of geometric structures" (1999): a
/// closed surface that bends inward at no edge bounds a convex body iff some point is strictly below all of
/// its faces and a ray from there through the middle of one face meets no other. Without the condition on
/// edges the body is star-shaped about the point (tried: the mean of the vertices). A face without area is
/// below nothing, so components with one are kOther. Cost O(faces).
SolidShape shape_of_solid(const TriangleMesh& mesh, const Component& component);

}  // namespace penumbra::detail
