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
constexpr double kRounding = 0x1p-46;  // over the largest coordinate
constexpr double kOnPlane = 1e-9;      // what rounding leaves between a face and its own plane

/// In front of the plane at least this far is every point of the disk; of a distant light so far at unit distance.
double nearest_of_disk(const CircularLight& light, const Vec3& normal, double center_in_front) {
  const double along = glm::dot(normal, unit(light.normal));
  return center_in_front - light.radius * std::sqrt(std::max(0.0, 1.0 - along * along));
}

}  // namespace

ReceiverCloud::ReceiverCloud(std::vector<Vec3> positions)
    : positions_(std::move(positions)), boxes_((positions_.size() + kPerBox - 1) / kPerBox) {
  tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t k) {
    Bounds bounds;
    for (std::size_t i = k * kPerBox; i < std::min((k + 1) * kPerBox, positions_.size()); ++i)
      bounds.add(positions_[i]);
    boxes_[k] = {bounds.center(), 0.5 * (bounds.high - bounds.low)};
  });
}

double ReceiverCloud::nearest_along(const Vec3& normal) const {
  const Vec3 steep = glm::abs(normal);
  const auto least_of = [&](const Box& box) {
    return glm::dot(normal, box.middle) - glm::dot(steep, box.half);
  };
  double nearest = std::numeric_limits<double>::infinity();
  const auto look_into = [&](std::size_t k) {
    for (std::size_t i = k * kPerBox; i < std::min((k + 1) * kPerBox, positions_.size()); ++i)
      nearest = std::min(nearest, glm::dot(normal, positions_[i]));
  };
  // First where the nearest one is likely to be, so that most of the others need no look.
  std::size_t first = boxes_.size();
  double least = nearest;
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    if (least_of(boxes_[k]) < least) least = least_of(boxes_[first = k]);
  if (first < boxes_.size()) look_into(first);
  const double rounding = kRounding * reach();
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    if (k != first && least_of(boxes_[k]) < nearest - rounding) look_into(k);
  return nearest;
}

double ReceiverCloud::reach() const {
  double most = 0.0;
  for (const Box& box : boxes_) most = std::max(most, largest_component(glm::abs(box.middle) + box.half));
  return most;
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
    const double steep = (glm::distance(p[1], p[0]) + glm::distance(p[2], p[0])) / length;
    for (const double side : {1.0, -1.0}) add_plane(corners, side / length * normal, p[0], steep);
  }
  if (planes_.size() > 2 * kMostPlanes) planes_.clear();
  for (const Vec3& p : corners) extent_ = std::max(extent_, largest_component(p));
}

void CasterPlanes::add_plane(const std::vector<Vec3>& corners, const Vec3& normal, const Vec3& point,
                             double steep) {
  Plane plane{.normal = normal, .offset = glm::dot(normal, point), .behind = {}, .steep = steep};
  const auto is_plane = [&](const Plane& other) {
    return glm::length(other.normal - plane.normal) + std::abs(other.offset - plane.offset) < kOnPlane;
  };
  if (std::any_of(planes_.begin(), planes_.end(), is_plane)) return;
  for (std::size_t f = 0; f < faces_; ++f)
    plane.behind.push_back(std::all_of(&corners[3 * f], &corners[3 * f] + 3,
                                       [&](const Vec3& p) { return plane.in_front(p) <= kOnPlane; }));
  planes_.push_back(std::move(plane));
}

/// Coordinates of corners round by u M, M the largest, hence the normal by u M · steep, and the value of a receiver by as much
/// times its distance.
void CasterPlanes::set_receivers(const ReceiverCloud& receivers) {
  const double reach = receivers.reach();
  tbb::parallel_for(std::size_t{0}, planes_.size(), [&](std::size_t k) {
    Plane& plane = planes_[k];
    plane.nearest = receivers.nearest_along(plane.normal) - plane.offset;
    plane.rounding = kRounding * (extent_ + reach + extent_ * plane.steep * (extent_ + reach));
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
    if (plane.nearest < -slack - plane.rounding) continue;
    const double in_front = glm::dot(plane.normal, light.center) - light.weight * plane.offset;
    if (nearest_of_disk(light, plane.normal, in_front) < 0.0) continue;
    for (std::size_t f = 0; f < faces_; ++f) separated[f] = separated[f] || plane.behind[f];
  }
  return !planes_.empty() &&
         std::all_of(separated.begin(), separated.end(), [](char each) { return each != 0; });
}

namespace {

/// Every `step`-th receiver's point in the frame, of those that are present.
ReceiverCloud cloud_of(const RayFrame& frame, const Receivers& receivers, std::size_t step) {
  std::vector<Vec3> points;
  points.reserve(receivers.size() / step + 1);
  for (std::size_t i = 0; i < receivers.size(); i += step)
    if (receivers.is_present(i)) points.push_back(frame.to_local(receivers.points[i]));
  return ReceiverCloud(std::move(points));
}

}  // namespace

std::vector<char> find_casters_that_cannot_occlude(const Scene& scene, const CircularLight& light,
                                                   const RayFrame& frame, const Receivers& receivers) {
  constexpr std::size_t kSome = 1009;  // a prime: spread over rows and columns
  std::vector<char> out(scene.objects.size(), 0);
  std::optional<ReceiverCloud> some, all;  // when they are needed
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!scene.objects[k].casts) continue;
    CasterPlanes planes(scene.objects[k].mesh, frame.origin, frame.scale);
    if (!planes.cannot_occlude(light)) continue;
    if (!some) some.emplace(cloud_of(frame, receivers, kSome));
    planes.set_receivers(*some);  // rules most casters out at little cost
    if (!planes.cannot_occlude(light)) continue;
    if (!all) all.emplace(cloud_of(frame, receivers, 1));
    planes.set_receivers(*all);
    out[k] = planes.cannot_occlude(light);
  }
  return out;
}

}  // namespace penumbra::detail
