// Casters that hide nothing from any receiver of the image: a floor, a wall, a room seen from inside.
//
// A face hides nothing where a plane has it on one side and all of the light and every receiver on the other.
// Such casters would only cost time, and widen the D-buffer's targets: a floor that casts spreads its texels
// over all of the floor.
#pragma once

#include <limits>
#include <vector>

#include "penumbra/render/receivers/receivers.h"
#include "penumbra/render/scene/scene.h"
#include "render/scene/ray_frame.h"

namespace penumbra::detail {

/// Receivers of an image, and boxes of some that follow each other.
class ReceiverCloud {
 public:
  /// In the frame of the planes. Cost O(receivers), on all cores.
  explicit ReceiverCloud(std::vector<Vec3> positions);
  /// The least of normal · p over all receivers p, to 1e-12; infinite without any. Cost O(boxes), and the
  /// receivers of a few.
  double nearest_along(const Vec3& normal) const;
  /// The largest coordinate; 0 without any.
  double reach() const;

 private:
  struct Box {
    Vec3 middle{0.0}, half{0.0};
  };
  std::vector<Vec3> positions_;
  std::vector<Box> boxes_;
};

/// A caster's faces and the planes that they lie in, if it has few.
class CasterPlanes {
 public:
  /// Planes and receivers are in the frame (p - origin) · scale, p in the scene. Cost O(1): a mesh of more
  /// than a hundred faces or of more than sixteen planes is not looked at, and never left out.
  CasterPlanes(const TriangleMesh& mesh, const Vec3& origin, double scale);
  /// Of the image, in the frame.
  void set_receivers(const ReceiverCloud& receivers);
  /// True where every face is separated from the light and from the receivers by one of the planes. Receivers may lie
  /// behind it as far as double cannot tell, and by `slack`, in the frame. Before receivers are set there are none. Cost O(1).
  bool cannot_occlude(const CircularLight& light, double slack = 0.0) const;

 private:
  struct Plane {
    Vec3 normal;  ///< unit
    double offset;
    std::vector<char> behind;                                  ///< one per face: no point of it is in front
    double nearest = std::numeric_limits<double>::infinity();  ///< of the receivers, in front
    double
        steep;  ///< how much more than coordinates the normal rounds: the two sides of its face over their product
    double rounding = 0.0;  ///< of `nearest`
    double in_front(const Vec3& p) const;
  };
  void add_plane(const std::vector<Vec3>& corners, const Vec3& normal, const Vec3& point, double steep);

  Vec3 origin_;
  double scale_;
  std::vector<Plane> planes_;  ///< each twice, once for either orientation; none where there are many
  double extent_ = 0.0;        ///< the largest coordinate
  std::size_t faces_ = 0;
};

/// One flag an object: casters that hide nothing from the receivers. Cost O(objects), and O(pixels) where a floor, wall or room casts.
std::vector<char> find_casters_that_cannot_occlude(const Scene& scene, const CircularLight& light,
                                                   const RayFrame& frame, const Receivers& receivers);

}  // namespace penumbra::detail
