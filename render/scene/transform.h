// An object's place in the world, with glTF's conventions: column-major matrix, or translation · rotation ·
// scale.
#pragma once

#include <array>

#include "penumbra/mesh/types.h"
#include "render/scene/scene_node.h"

namespace penumbra::detail {

/// world = columns · p + translation, in double.
struct Transform {
  std::array<Vec3, 3> columns{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  Vec3 translation{0.0};

  Vec3 apply(const Vec3& p) const {
    return columns[0] * p.x + columns[1] * p.y + columns[2] * p.z + translation;
  }
  /// The determinant of the columns scaled to unit length: in [-1, 1], 0 where the matrix is singular.
  double relative_determinant() const;
  bool mirrors() const { return relative_determinant() < 0.0; }
};

/// Reads `matrix`, or `translation`, `rotation` and `scale`, of an object. Throws SceneError naming the key.
Transform read_transform(const SceneNode& object);

}  // namespace penumbra::detail
