#include "render/receivers/occluding_casters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kMostFaces = 100, kMostPlanes = 16;
constexpr std::size_t kPerBox = 64;
constexpr double kRounding = 1e-12;  // in a frame of size 1: a box that is nearer by less is not looked into
constexpr double kOnPlane = 1e-9;    // what rounding leaves between a face and its own plane

/// In front of the plane at least this far is every point of the disk; of a distant light so far at unit distance.
double nearest_of_disk(const CircularLight& light, const Vec3& normal, double center_in_front) {
  const double along = glm::dot(normal, unit(light.normal));
  return center_in_front - light.radius * std::sqrt(std::max(0.0, 1.0 - along * along));
}

}  // namespace

ReceiverCloud::ReceiverCloud(std::span<const glm::vec4> positions)
    : positions_(positions), boxes_((positions.size() + kPerBox - 1) / kPerBox) {
  tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t k) {
    Bounds bounds;
    for (const glm::vec4& p :
         positions.subspan(k * kPerBox, std::min(kPerBox, positions.size() - k * kPerBox)))
      if (p.w != 0.0f) bounds.add(Vec3(p));
    if (!bounds.empty()) boxes_[k] = {bounds.center(), 0.5 * (bounds.high - bounds.low), false};
  });
}

double ReceiverCloud::nearest_along(const Vec3& normal) const {
  const Vec3 reach = glm::abs(normal);
  const auto least_of = [&](const Box& box) {
    return glm::dot(normal, box.middle) - glm::dot(reach, box.half);
  };
  double nearest = std::numeric_limits<double>::infinity();
  const auto look_into = [&](std::size_t k) {
    for (const glm::vec4& p :
         positions_.subspan(k * kPerBox, std::min(kPerBox, positions_.size() - k * kPerBox)))
      if (p.w != 0.0f) nearest = std::min(nearest, glm::dot(normal, Vec3(p)));
  };
  // First where the nearest one is likely to be, so that most of the others need no look.
  std::size_t first = boxes_.size();
  double least = nearest;
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    if (!boxes_[k].empty && least_of(boxes_[k]) < least) least = least_of(boxes_[first = k]);
  if (first < boxes_.size()) look_into(first);
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    if (!boxes_[k].empty && k != first && least_of(boxes_[k]) < nearest - kRounding) look_into(k);
  return nearest;
}

double CasterPlanes::Plane::in_front(const Vec3& p) const {
  return glm::dot(normal, p) - offset;
}

CasterPlanes::CasterPlanes(const TriangleMesh& mesh, const Vec3& origin, double scale)
    : origin_(origin), scale_(scale) {
  if (mesh.triangles().size() > kMostFaces) return;
  std::vector<Vec3> corners;  // three a face
  for (const IndexedTriangle& t : mesh.triangles())
    for (const std::uint32_t v : t) corners.push_back((mesh.positions()[v] - origin) * scale);
  faces_ = mesh.triangles().size();
  for (std::size_t f = 0; f < faces_ && planes_.size() <= 2 * kMostPlanes; ++f) {
    const Vec3* p = &corners[3 * f];
    const Vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double length = glm::length(normal);
    if (!(length > 0.0)) continue;
    for (const double side : {1.0, -1.0}) add_plane(corners, side / length * normal, p[0]);
  }
  if (planes_.size() > 2 * kMostPlanes) planes_.clear();
}

void CasterPlanes::add_plane(const std::vector<Vec3>& corners, const Vec3& normal, const Vec3& point) {
  Plane plane{normal, glm::dot(normal, point), {}};
  const auto is_plane = [&](const Plane& other) {
    return glm::length(other.normal - plane.normal) + std::abs(other.offset - plane.offset) < kOnPlane;
  };
  if (std::any_of(planes_.begin(), planes_.end(), is_plane)) return;
  for (std::size_t f = 0; f < faces_; ++f)
    plane.behind.push_back(std::all_of(&corners[3 * f], &corners[3 * f] + 3,
                                       [&](const Vec3& p) { return plane.in_front(p) <= kOnPlane; }));
  planes_.push_back(std::move(plane));
}

void CasterPlanes::set_receivers(const ReceiverCloud& receivers) {
  tbb::parallel_for(std::size_t{0}, planes_.size(), [&](std::size_t k) {
    planes_[k].nearest = receivers.nearest_along(planes_[k].normal) - planes_[k].offset;
  });
}

bool CasterPlanes::cannot_occlude(const CircularLight& world, double slack) const {
  CircularLight light = world;
  if (light.is_distant()) {
    light.center = -unit(light.normal);
  } else {
    light.center = (light.center - origin_) * scale_;
    light.radius *= scale_;
  }
  std::vector<char> separated(faces_, 0);
  for (const Plane& plane : planes_) {
    if (plane.nearest < -slack) continue;
    const double in_front = glm::dot(plane.normal, light.center) - light.weight * plane.offset;
    if (nearest_of_disk(light, plane.normal, in_front) < 0.0) continue;
    for (std::size_t f = 0; f < faces_; ++f) separated[f] = separated[f] || plane.behind[f];
  }
  return !planes_.empty() &&
         std::all_of(separated.begin(), separated.end(), [](char each) { return each != 0; });
}

namespace {

/// Every `step`-th receiver's, as CasterPlanes takes them.
std::vector<glm::vec4> ray_origins(const RayFrame& frame, const Receivers& receivers, std::size_t step) {
  std::vector<glm::vec4> out((receivers.size() + step - 1) / step, glm::vec4(0.0f));
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t k) {
    const std::size_t i = k * step;
    if (!receivers.is_present(i)) return;
    Vec3 origin = frame.to_local(receivers.points[i]);
    if (receivers.has_normals()) origin += kRayOffset * receivers.normals[i];
    out[k] = glm::vec4(glm::vec3(origin), 1.0f);
  });
  return out;
}

}  // namespace

std::vector<char> find_casters_that_cannot_occlude(const Scene& scene, const CircularLight& light,
                                                   const RayFrame& frame, const Receivers& receivers) {
  constexpr std::size_t kSome = 1009;  // a prime: spread over rows and columns
  std::vector<char> out(scene.objects.size(), 0);
  std::vector<glm::vec4> some, all;  // when they are needed
  std::optional<ReceiverCloud> cloud;
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!scene.objects[k].casts) continue;
    CasterPlanes planes(scene.objects[k].mesh, frame.origin, frame.scale);
    if (!planes.cannot_occlude(light)) continue;
    if (some.empty()) some = ray_origins(frame, receivers, kSome);
    planes.set_receivers(ReceiverCloud(some));  // rules most casters out at little cost
    if (!planes.cannot_occlude(light)) continue;
    if (all.empty()) all = ray_origins(frame, receivers, 1);
    if (!cloud) cloud.emplace(all);
    planes.set_receivers(*cloud);
    out[k] = planes.cannot_occlude(light);
  }
  return out;
}

}  // namespace penumbra::detail
