#include "apps/viewer/handles/light_handles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "mesh/vectors.h"

namespace penumbra::viewer {
namespace {

using detail::unit;

constexpr double kArrow = 70.0;  // pixels
constexpr int kRimCorners = 64;
constexpr double kFlat = 1e-3;  // sine below which a line lies along, a plane edge-on to, the pointer's ray

Vec3 axis_of(Handle handle) {
  if (handle == Handle::kAxisX) return {1, 0, 0};
  return handle == Handle::kAxisY ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
}

// Pixels from the pointer; infinite where the segment is not in front of the eye.
double reach_to(const Projection& projection, const Vec3& a, const Vec3& b, const PicturePoint& pointer) {
  const auto from = projection.project(a), to = projection.project(b);
  return from && to ? distance_to_segment(pointer, *from, *to) : INFINITY;
}

double reach_to(const Projection& projection, const Vec3& a, const PicturePoint& pointer) {
  return reach_to(projection, a, a, pointer);
}

std::optional<Vec3> on_plane(const Vec3& eye, const Vec3& direction, const Vec3& point, const Vec3& normal) {
  const double slope = glm::dot(unit(direction), normal);
  if (std::abs(slope) < kFlat) return std::nullopt;
  const double along = glm::dot(point - eye, normal) / glm::dot(direction, normal);
  return along > 0.0 ? std::optional(eye + along * direction) : std::nullopt;
}

// The point of the axis that is nearest to the ray.
std::optional<Vec3> on_axis(const Vec3& eye, const Vec3& direction, const Vec3& point, const Vec3& axis) {
  const Vec3 d = unit(direction);
  const double cosine = glm::dot(d, axis), square = 1.0 - cosine * cosine;
  if (square < kFlat) return std::nullopt;
  const Vec3 offset = point - eye;
  const double along = (cosine * glm::dot(d, offset) - glm::dot(axis, offset)) / square;
  return point + along * axis;
}

// Where the ray meets the sphere, on the side `like` is on; beside the sphere the point nearest to the ray.
Vec3 on_sphere(const Vec3& eye, const Vec3& direction, const Vec3& center, double radius, const Vec3& like) {
  const Vec3 d = unit(direction);
  const double middle = glm::dot(center - eye, d);
  const Vec3 nearest = eye + middle * d;
  const double off = glm::length(nearest - center);
  if (off >= radius) return center + radius * unit(nearest - center);
  const double half = std::sqrt(radius * radius - off * off);
  const bool far_side = glm::dot(like - center, d) > 0.0;
  return eye + (middle + (far_side ? half : -half)) * d;
}

}  // namespace

const char* name_of(Handle handle) {
  constexpr std::array kNames{"none", "x", "y", "z", "center", "rim", "normal"};
  return kNames[static_cast<std::size_t>(handle)];
}

HandleShape handle_shape(const HandledLight& light, const Projection& projection) {
  const DiskLight& disk = light.disk;
  HandleShape shape;
  shape.center = disk.center;
  const double arm = kArrow * projection.units_per_pixel(disk.center);
  for (int k = 0; k < 3 && !light.middle; ++k) {
    shape.axis_tips.push_back(disk.center);
    shape.axis_tips.back()[k] += arm;
  }
  const LightFrame frame = light_frame(disk);
  shape.normal_tip = disk.center + arm * frame.w;
  for (int i = 0; i < kRimCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRimCorners;
    shape.rim.push_back(disk.center + disk.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
  }
  // The corner furthest to the left in the picture: away from the arrows to the right.
  shape.rim_knob = *std::min_element(shape.rim.begin(), shape.rim.end(), [&](const Vec3& a, const Vec3& b) {
    return glm::dot(a, projection.right()) < glm::dot(b, projection.right());
  });
  if (light.middle) {
    const Vec3 left = glm::cross(frame.w, glm::cross(-projection.right(), frame.w));
    shape.rim_knob = disk.center +
                     (disk.radius + 0.5 * arm) * (glm::length(left) > kFlat ? glm::normalize(left) : frame.u);
  }
  return shape;
}

Handle pick(const HandleShape& shape, const Projection& projection, const PicturePoint& pointer,
            double reach) {
  Handle best = Handle::kNone;
  double nearest = reach;
  const auto offer = [&](Handle handle, double pixels) {
    if (pixels < nearest) {
      nearest = pixels;
      best = handle;
    }
  };
  offer(Handle::kNormal, reach_to(projection, shape.normal_tip, pointer));
  offer(Handle::kRim, reach_to(projection, shape.rim_knob, pointer));
  const std::size_t axes = shape.axis_tips.size();
  for (std::size_t k = 0; k < axes; ++k)
    offer(kAxisHandles[k], reach_to(projection, shape.axis_tips[k], pointer));
  if (best != Handle::kNone) return best;
  offer(Handle::kCenter, reach_to(projection, shape.center, pointer));
  if (best != Handle::kNone) return best;
  for (std::size_t k = 0; k < axes; ++k)
    offer(kAxisHandles[k], reach_to(projection, shape.center, shape.axis_tips[k], pointer));
  if (best != Handle::kNone) return best;
  for (std::size_t i = 0; i < shape.rim.size(); ++i)
    offer(Handle::kRim, reach_to(projection, shape.rim[i], shape.rim[(i + 1) % shape.rim.size()], pointer));
  return best;
}

HandleDrag::HandleDrag(Handle handle, const HandledLight& light, const Projection& projection,
                       const PicturePoint& start, const std::optional<Vec3>& aim)
    : handle_(handle),
      start_(light),
      aim_(light.middle ? std::nullopt : aim),
      arm_(kArrow * projection.units_per_pixel(light.disk.center)),
      start_grip_(grip(projection, start)) {}

std::optional<Vec3> HandleDrag::grip(const Projection& projection, const PicturePoint& pointer) const {
  const Vec3 &eye = projection.eye(), &center = start_.disk.center;
  const Vec3 direction = projection.direction(pointer);
  const Vec3 normal = light_frame(start_.disk).w;
  switch (handle_) {
    case Handle::kAxisX:
    case Handle::kAxisY:
    case Handle::kAxisZ:
      return on_axis(eye, direction, center, axis_of(handle_));
    case Handle::kCenter:
      return start_.middle
                 ? on_sphere(eye, direction, *start_.middle, glm::length(center - *start_.middle), center)
                 : on_plane(eye, direction, center, projection.forward());
    case Handle::kRim: {
      const auto hit = on_plane(eye, direction, center, normal);
      return hit ? hit : on_plane(eye, direction, center, projection.forward());
    }
    case Handle::kNormal:
      return on_sphere(eye, direction, center, arm_, center + arm_ * normal);
    case Handle::kNone:
      break;
  }
  return std::nullopt;
}

HandledLight HandleDrag::moved_to(const Projection& projection, const PicturePoint& pointer) const {
  const auto now = grip(projection, pointer);
  if (!now || !start_grip_) return start_;
  HandledLight light = start_;
  DiskLight& disk = light.disk;
  if (handle_ == Handle::kRim) {
    const double before = glm::length(*start_grip_ - start_.disk.center);
    disk.radius = std::max(0.0, start_.disk.radius + glm::length(*now - start_.disk.center) - before);
  } else if (handle_ == Handle::kNormal) {
    disk.normal = unit(*now - start_.disk.center);
  } else {
    disk.center = start_.disk.center + (*now - *start_grip_);
    const std::optional<Vec3>& shone_at = light.middle ? light.middle : aim_;
    if (shone_at && *now != *start_grip_ && *shone_at != disk.center)
      disk.normal = unit(*shone_at - disk.center);
  }
  if (light.middle && disk.normal != start_.disk.normal)
    disk.center = *light.middle - glm::length(start_.disk.center - *light.middle) * disk.normal;
  return light;
}

}  // namespace penumbra::viewer
