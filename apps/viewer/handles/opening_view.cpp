#include "apps/viewer/handles/opening_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "apps/viewer/handles/light_handles.h"

namespace penumbra::viewer {
namespace {

constexpr double kMargin = 0.04;         // of the picture, on each side
constexpr double kLeastShare = 1.0 / 6;  // of the picture's height that the casters keep

std::vector<Vec3> corners_of(const Bounds& b) {
  std::vector<Vec3> out;
  for (int i = 0; i < 8; ++i)
    out.push_back({i & 1 ? b.high.x : b.low.x, i & 2 ? b.high.y : b.low.y, i & 4 ? b.high.z : b.low.z});
  return out;
}

// Its rim and the tips of its handles, as they are seen through this camera.
std::vector<Vec3> points_of(const HandledLight& light, const Camera& camera, int width, int height) {
  HandleShape shape = handle_shape(light, Projection(camera, width, height));
  std::vector<Vec3> out = std::move(shape.rim);
  out.insert(out.end(), shape.axis_tips.begin(), shape.axis_tips.end());
  out.insert(out.end(), {shape.normal_tip, shape.rim_knob});
  return out;
}

// Where the box's shadow from the light's center falls on the plane through the scene's lowest point, as far
// as the scene goes.
std::vector<Vec3> shadow_of(const Bounds& casters, const Bounds& scene, const Vec3& light, const Vec3& up) {
  double ground = INFINITY;
  const std::vector<Vec3> corners = corners_of(casters);
  for (const Vec3& p : corners_of(scene)) ground = std::min(ground, glm::dot(p, up));
  std::vector<Vec3> out;
  for (const Vec3& p : corners) {
    const double above = glm::dot(p, up) - ground, fall = glm::dot(light - p, up);
    if (!(fall > 0.0)) continue;
    const Vec3 q = p + (p - light) * (above / fall);
    if (glm::all(glm::lessThanEqual(glm::abs(q - scene.center()),
                                    0.5 * (scene.high - scene.low) + Vec3(casters.radius()))))
      out.push_back(q);
  }
  return out;
}

bool shows(const Projection& projection, const std::vector<Vec3>& points, int width, int height) {
  return std::ranges::all_of(points, [&](const Vec3& p) {
    const auto at = projection.project(p);
    return at && at->x > 0.0 && at->y > 0.0 && at->x < width && at->y < height;
  });
}

// A pinhole that looks along -z from (x, y, z), its half extents at depth 1 being (s, t), sees p where |p.x -
// x| ≤ s (z - p.z) and |p.y - y| ≤ t (z - p.z). The least z for each direction, and the middle of what is
// then left. The target is as far away as the first point.
Camera fitted(const Camera& camera, const std::vector<Vec3>& points, int width, int height) {
  const Projection projection(camera, width, height);
  const Vec3 right = projection.right(), up = projection.up(), back = -projection.forward();
  const double t = (1.0 - 2.0 * kMargin) * std::tan(glm::radians(camera.fov_y_degrees) / 2.0);
  const double s = t * width / height;
  double right_most = -INFINITY, left_most = INFINITY, top = -INFINITY, bottom = INFINITY;
  for (const Vec3& p : points) {
    const double x = glm::dot(p, right), y = glm::dot(p, up), z = glm::dot(p, back);
    right_most = std::max(right_most, x + s * z);
    left_most = std::min(left_most, x - s * z);
    top = std::max(top, y + t * z);
    bottom = std::min(bottom, y - t * z);
  }
  const double z = std::max((right_most - left_most) / (2.0 * s), (top - bottom) / (2.0 * t));
  Camera out = camera;
  out.eye = 0.5 * (right_most + left_most) * right + 0.5 * (top + bottom) * up + z * back;
  out.target = out.eye - (z - glm::dot(points.front(), back)) * back;
  return out;
}

}  // namespace

Camera with_light_in_view(const Camera& camera, const Scene& scene, const HandledLight& light, int width,
                          int height) {
  const Bounds casters = scene.caster_bounds().empty() ? scene.bounds() : scene.caster_bounds();
  if (width < 1 || height < 1 || casters.empty() || !(casters.radius() > 0.0) ||
      shows(Projection(camera, width, height), points_of(light, camera, width, height), width, height))
    return camera;
  std::vector<Vec3> fixed = corners_of(casters);
  const std::vector<Vec3> shadow =
      shadow_of(casters, scene.bounds(), light.disk.center, glm::normalize(camera.up));
  fixed.insert(fixed.begin(), casters.center());
  fixed.push_back(camera.target);
  fixed.insert(fixed.end(), shadow.begin(), shadow.end());
  Camera moved = camera;
  // Handles are as long in the picture wherever the camera is, and so in the scene the longer, the further
  // away it is.
  for (int round = 0; round < 8; ++round) {
    std::vector<Vec3> points = fixed;
    const std::vector<Vec3> more = points_of(light, moved, width, height);
    points.insert(points.end(), more.begin(), more.end());
    moved = fitted(camera, points, width, height);
  }
  const double pixels =
      2.0 * casters.radius() / Projection(moved, width, height).units_per_pixel(casters.center());
  return pixels >= kLeastShare * height ? moved : camera;
}

}  // namespace penumbra::viewer
