// The camera: a pinhole with square pixels.
#pragma once

#include "penumbra/mesh/types.h"

namespace penumbra {

struct Camera {
  Vec3 eye{0.0, 1.0, 4.0};  ///< scene units
  Vec3 target{0.0};
  Vec3 up{0.0, 1.0, 0.0};       ///< any vector not parallel to the line of sight
  double fov_y_degrees = 40.0;  ///< vertical field of view, in (0, 180)
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// The ray through a point of the image: origin eye, direction not normalised (length 1 along the line of
/// sight).
struct PixelRays {
  PixelRays(const Camera& camera, int width, int height);
  Vec3 origin;
  /// Direction through (x, y) in pixels, (0, 0) the top left corner of the image; a pixel's center is at +
  /// 0.5.
  Vec3 direction(double x, double y) const;

 private:
  Vec3 corner_, across_, down_;
};

}  // namespace penumbra
