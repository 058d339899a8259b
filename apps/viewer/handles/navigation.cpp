#include "apps/viewer/handles/navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"

namespace penumbra::viewer {
namespace {

using detail::unit;

constexpr double kSteepest = 89.5 * std::numbers::pi / 180.0;

// Two horizontal axes and the vertical one.
struct Turntable {
  Vec3 front, right, up;
};

Turntable turntable(const Vec3& world_up) {
  const Vec3 up = unit(world_up);
  // With y up: front is +z and right is +x.
  const Vec3 hint = std::abs(up.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
  const Vec3 front = unit(hint - up * glm::dot(hint, up));
  return {front, glm::cross(up, front), up};
}

}  // namespace

Camera rotated(const Camera& camera, const Vec3& world_up, double yaw, double pitch) {
  const Turntable axes = turntable(world_up);
  const Vec3 offset = camera.eye - camera.target;
  const double length = glm::length(offset);
  const double height = std::asin(std::clamp(glm::dot(offset, axes.up) / length, -1.0, 1.0));
  // Seen from straight above, the picture's up tells where the front is.
  const bool vertical = std::cos(height) < 1e-6;
  const Vec3 flat = vertical ? (height > 0.0 ? -camera.up : camera.up) : offset;
  const double angle = std::atan2(glm::dot(flat, axes.right), glm::dot(flat, axes.front)) + yaw;
  const double raised = std::clamp(height + pitch, -kSteepest, kSteepest);
  Camera out = camera;
  out.eye = camera.target +
            length * (std::cos(raised) * (std::cos(angle) * axes.front + std::sin(angle) * axes.right) +
                      std::sin(raised) * axes.up);
  out.up = world_up;
  return out;
}

Camera panned(const Camera& camera, int width, int height, double x_pixels, double y_pixels) {
  const Projection projection(camera, width, height);
  const double scale = projection.units_per_pixel(camera.target);
  const Vec3 move = scale * (-x_pixels * projection.right() + y_pixels * projection.up());
  Camera out = camera;
  out.eye += move;
  out.target += move;
  return out;
}

Camera zoomed(const Camera& camera, const Vec3& pivot, double factor) {
  Camera out = camera;
  out.eye = pivot + (camera.eye - pivot) * factor;
  out.target = pivot + (camera.target - pivot) * factor;
  return out.eye == out.target ? camera : out;
}

Camera seen_from(const Camera& camera, const Vec3& world_up, StandardView view) {
  const Turntable axes = turntable(world_up);
  const double length = glm::length(camera.eye - camera.target);
  Camera out = camera;
  const Vec3& side = view == StandardView::kFront   ? axes.front
                     : view == StandardView::kRight ? axes.right
                                                    : axes.up;
  out.eye = camera.target + length * side;
  out.up = view == StandardView::kTop ? -axes.front : world_up;
  return out;
}

Camera framed(const Camera& camera, const Bounds& bounds, int width, int height) {
  if (bounds.empty() || !(bounds.radius() > 0.0)) return camera;
  const double half_y = camera.fov_y_degrees * std::numbers::pi / 360.0;
  const double half_x = std::atan(std::tan(half_y) * width / height);
  const double length = 1.15 * bounds.radius() / std::sin(std::min(half_x, half_y));
  const Vec3 direction = unit(camera.eye - camera.target);
  Camera out = camera;
  out.target = bounds.center();
  out.eye = out.target + length * direction;
  return out;
}

Camera centered(const Camera& camera, const Vec3& target) {
  Camera out = camera;
  const Vec3 sight = unit(target - camera.eye);
  if (glm::length(glm::cross(sight, unit(camera.up))) < 1e-3) return camera;
  out.target = target;
  return out;
}

}  // namespace penumbra::viewer
