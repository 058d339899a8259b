#include "penumbra/render/scene/camera.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"

namespace penumbra {

using detail::unit;

PixelRays::PixelRays(const Camera& camera, int width, int height) : origin(camera.eye) {
  assert(width > 0 && height > 0);
  const Vec3 forward = unit(camera.target - camera.eye);
  const Vec3 right = unit(glm::cross(forward, unit(camera.up)));
  const Vec3 up = glm::cross(right, forward);
  // The image plane at distance 1: its height follows from the field of view, its width from square pixels.
  const double half_height = std::tan(camera.fov_y_degrees * std::numbers::pi / 360.0);
  const double pixel = 2.0 * half_height / height;
  across_ = right * pixel;
  down_ = up * -pixel;
  corner_ = forward - across_ * (0.5 * width) - down_ * (0.5 * height);
}

Vec3 PixelRays::direction(double x, double y) const {
  return corner_ + across_ * x + down_ * y;
}

}  // namespace penumbra
