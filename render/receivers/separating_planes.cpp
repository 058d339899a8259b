#include "render/receivers/separating_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "mesh/vectors.h"

namespace penumbra::detail {
namespace {

constexpr std::size_t kMostFaces = 100, kMostPlanes = 16;

bool all_corners(const FaceCorners& face, const auto& test) {
  return test(face.a) && test(face.b) && test(face.c);
}

/// Double can tell the plane: a point one edge's length off the face lies on one side of it.
bool is_plane(const FaceCorners& f) {
  const Vec3 n = glm::cross(f.b - f.a, f.c - f.a);
  const double length = glm::length(n);
  return length > 0.0 && side_of_plane(f, f.a + n * (glm::length(f.b - f.a) / length)) != 0;
}

/// Whether a disk that is not distant lies in front of the plane or touches it, as far as double can tell: so
/// does then its point farthest against the plane's normal.
bool is_in_front(const CircularLight& light, const SeparatingPlanes::Plane& plane, const Vec3& n) {
  const Vec3 m = unit(light.normal), within = n - glm::dot(n, m) * m;
  const double length = glm::length(within);
  const Vec3 farthest = length > 0.0 ? light.center - (light.radius / length) * within : light.center;
  return plane.front * side_of_plane(plane.face, farthest) >= 0;
}

/// The same of a distant light: every point d of it has N·d of at least N·c - r|N × m|, which is known to
/// some roundings of |N|.
bool distant_is_in_front(const CircularLight& light, const Vec3& n) {
  constexpr double kRounding = 0x1p-50;
  const Vec3 m = unit(light.normal);
  return -glm::dot(n, m) - light.radius * glm::length(glm::cross(n, m)) >=
         -kRounding * (1.0 + light.radius) * glm::length(n);
}

bool is_in_front(const CircularLight& light, const SeparatingPlanes::Plane& plane) {
  const FaceCorners& f = plane.face;
  const Vec3 n = double(plane.front) * glm::cross(f.b - f.a, f.c - f.a);
  return light.is_distant() ? distant_is_in_front(light, n) : is_in_front(light, plane, n);
}

}  // namespace

SeparatingPlanes::SeparatingPlanes(const TriangleMesh& mesh) {
  if (mesh.triangles().size() > kMostFaces) return;
  std::vector<FaceCorners> faces;
  const auto p = mesh.positions();
  for (const IndexedTriangle& t : mesh.triangles()) faces.push_back({p[t[0]], p[t[1]], p[t[2]]});
  faces_ = faces.size();
  for (std::size_t f = 0; f < faces_ && planes_.size() <= 2 * kMostPlanes; ++f) {
    if (!is_plane(faces[f])) continue;
    if (std::ranges::any_of(planes_, [&](const Plane& plane) { return plane.within[f] != 0; })) continue;
    for (const int front : {1, -1}) add_plane(faces, faces[f], front);
  }
  if (planes_.size() > 2 * kMostPlanes) planes_.clear();
}

void SeparatingPlanes::add_plane(const std::vector<FaceCorners>& faces, const FaceCorners& face, int front) {
  Plane& plane = planes_.emplace_back(Plane{face, front, {}, {}});
  for (const FaceCorners& each : faces) {
    plane.behind.push_back(
        all_corners(each, [&](const Vec3& p) { return front * side_of_plane(face, p) <= 0; }));
    plane.within.push_back(all_corners(each, [&](const Vec3& p) { return side_of_plane(face, p) == 0; }));
  }
}

bool SeparatingPlanes::separate(const CircularLight& light,
                                const std::function<bool(const Plane&)>& suits) const {
  std::vector<char> separated(faces_, 0);
  for (const Plane& plane : planes_) {
    if (!is_in_front(light, plane) || !suits(plane)) continue;
    for (std::size_t f = 0; f < faces_; ++f) separated[f] = separated[f] || plane.behind[f];
  }
  return !planes_.empty() && std::ranges::all_of(separated, [](char each) { return each != 0; });
}

}  // namespace penumbra::detail
