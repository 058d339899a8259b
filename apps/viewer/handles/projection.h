// From the world to the picture and back, the same pinhole as render/scene/camera.h.
#pragma once

#include <array>
#include <optional>

#include "penumbra/render/scene/camera.h"

namespace penumbra::viewer {

/// A place in the picture in pixels, (0, 0) the top left corner.
struct PicturePoint {
  double x = 0.0, y = 0.0;
};
double distance(const PicturePoint& a, const PicturePoint& b);
/// From p to the segment a b.
double distance_to_segment(const PicturePoint& p, const PicturePoint& a, const PicturePoint& b);

class Projection {
 public:
  Projection(const Camera& camera, int width, int height);

  /// Where a point of the world is seen; none at or behind the eye.
  std::optional<PicturePoint> project(const Vec3& p) const;
  const Vec3& eye() const { return rays_.origin; }
  Vec3 direction(const PicturePoint& at) const { return rays_.direction(at.x, at.y); }
  /// Unit vector along the line of sight.
  const Vec3& forward() const { return forward_; }
  /// Along the line of sight from the eye, in scene units.
  double depth(const Vec3& p) const;
  /// Scene units a pixel at the depth of p.
  double units_per_pixel(const Vec3& p) const;
  /// Unit vectors to the right and up in the picture.
  Vec3 right() const;
  Vec3 up() const;
  /// World to OpenGL's clip space, column-major, for depths between `near` and `far`.
  std::array<float, 16> clip_matrix(double near, double far) const;

 private:
  PixelRays rays_;
  int width_, height_;
  Vec3 corner_, across_, down_, forward_;
};

}  // namespace penumbra::viewer
