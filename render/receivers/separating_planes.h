// Planes that have a caster on one side, and the light and receivers on the other.
#pragma once

#include <functional>
#include <vector>

#include "penumbra/mesh/triangle_mesh.h"
#include "penumbra/volumes/disk_light.h"
#include "render/support/plane_side.h"

namespace penumbra::detail {

/// The planes of a caster's faces, if there are few.
class SeparatingPlanes {
 public:
  struct Plane {
    FaceCorners face;
    /// Which side of the face is in front: 1 or -1 (side_of_plane).
    int front = 1;
    /// One a face of the mesh: no point of it is in front, as far as double can tell. And: it lies in the
    /// plane.
    std::vector<char> behind, within;
  };

  /// Cost O(1): a mesh of more than a hundred faces or of more than sixteen planes is not looked at, and none
  /// of it is ever separated.
  explicit SeparatingPlanes(const TriangleMesh& mesh);

  /// True where every face lies behind a plane that has all of the light in front, or on it, and for which
  /// `suits` holds.
  bool separate(const CircularLight& light, const std::function<bool(const Plane&)>& suits) const;

 private:
  void add_plane(const std::vector<FaceCorners>& faces, const FaceCorners& face, int front);

  std::vector<Plane> planes_;  ///< each twice, once for either side; none where there are many
  std::size_t faces_ = 0;
};

}  // namespace penumbra::detail
