#include "render/idle_casters.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "volumes/detail/vectors.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kMostFaces = 100, kMostPlanes = 16;
constexpr double kOnPlane = 1e-9;  // what rounding leaves between a face and its own plane

/// In front of the plane at least this far is every point of the disk.
double nearest_of_disk(const DiskLight& light, const Vec3& normal, double center_in_front) {
  const double along = glm::dot(normal, unit(light.normal));
  return center_in_front - light.radius * std::sqrt(std::max(0.0, 1.0 - along * along));
}

}  // namespace

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

void CasterPlanes::set_receivers(std::span<const glm::vec4> positions) {
  using Nearest = std::vector<double>;
  const Nearest none(planes_.size(), std::numeric_limits<double>::infinity());
  const Nearest nearest = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, planes_.empty() ? 0 : positions.size(), 16384), none,
      [&](const auto& range, Nearest out) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (positions[i].w == 0.0f) continue;
          const Vec3 p(positions[i]);
          for (std::size_t k = 0; k < planes_.size(); ++k) out[k] = std::min(out[k], planes_[k].in_front(p));
        }
        return out;
      },
      [](Nearest a, const Nearest& b) {
        for (std::size_t k = 0; k < a.size(); ++k) a[k] = std::min(a[k], b[k]);
        return a;
      });
  for (std::size_t k = 0; k < planes_.size(); ++k) planes_[k].nearest = nearest[k];
}

bool CasterPlanes::is_idle(const DiskLight& world, double slack) const {
  const DiskLight light{(world.center - origin_) * scale_, world.normal, world.radius * scale_};
  std::vector<char> idle(faces_, 0);
  for (const Plane& plane : planes_) {
    if (plane.nearest < -slack) continue;
    if (nearest_of_disk(light, plane.normal, plane.in_front(light.center)) < 0.0) continue;
    for (std::size_t f = 0; f < faces_; ++f) idle[f] = idle[f] || plane.behind[f];
  }
  return !planes_.empty() && std::all_of(idle.begin(), idle.end(), [](char each) { return each != 0; });
}

namespace {

/// Every `step`-th pixel's, as CasterPlanes takes them.
std::vector<glm::vec4> ray_origins(const RayFrame& frame, const SurfaceBuffer& surface, std::size_t step) {
  std::vector<glm::vec4> out((surface.size() + step - 1) / step, glm::vec4(0.0f));
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t k) {
    const std::size_t i = k * step;
    if (!surface.hit(i)) return;
    const Vec3 origin = frame.to_local(surface.position[i]) + kRayOffset * surface.normal[i];
    out[k] = glm::vec4(glm::vec3(origin), 1.0f);
  });
  return out;
}

}  // namespace

std::vector<char> find_idle_casters(const Scene& scene, const RayFrame& frame, const SurfaceBuffer& surface) {
  constexpr std::size_t kSome = 1009;  // a prime: spread over rows and columns
  std::vector<char> idle(scene.objects.size(), 0);
  std::vector<glm::vec4> some, all;  // when they are needed
  for (std::size_t k = 0; k < idle.size(); ++k) {
    if (!scene.objects[k].casts) continue;
    CasterPlanes planes(scene.objects[k].mesh, frame.origin, frame.scale);
    if (!planes.is_idle(scene.light)) continue;
    if (some.empty()) some = ray_origins(frame, surface, kSome);
    planes.set_receivers(some);  // rules most casters out at little cost
    if (!planes.is_idle(scene.light)) continue;
    if (all.empty()) all = ray_origins(frame, surface, 1);
    planes.set_receivers(all);
    idle[k] = planes.is_idle(scene.light);
  }
  return idle;
}

}  // namespace penumbra::detail
