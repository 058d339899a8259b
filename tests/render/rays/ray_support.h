// What tests of rays share: motions, places on and beside meshes, and packets that the oracle judges.
#pragma once

#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "render/rays/ray_packets.h"
#include "tests/oracle/oracle.h"
#include "tests/render/render_support.h"

namespace penumbra::testing {

/// p → s·R·p + t.
struct Motion {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< columns of s·R
  Vec3 offset{0.0};

  static Motion random(Random& random) {
    Motion out;
    out.x = random.direction();
    out.y = glm::normalize(glm::cross(out.x, random.direction()));
    out.z = glm::cross(out.x, out.y);
    out.offset = random.point(3.0);
    return out;
  }
  Vec3 turned(const Vec3& p) const { return p.x * x + p.y * y + p.z * z; }
  Vec3 operator()(const Vec3& p) const { return turned(p) + offset; }
  std::vector<Vec3> turned(std::vector<Vec3> points) const {
    for (Vec3& p : points) p = turned(p);
    return points;
  }
  std::vector<Vec3> operator()(std::vector<Vec3> points) const {
    for (Vec3& p : points) p = (*this)(p);
    return points;
  }
};

struct FacePoint {
  Vec3 point, normal;
  std::uint32_t object, face;
};
inline FacePoint random_face_point(Random& random, std::span<const TriangleMesh> meshes) {
  const auto object = static_cast<std::uint32_t>(random.uniform(0.0, static_cast<double>(meshes.size())));
  const TriangleMesh& mesh = meshes[object];
  const auto face =
      static_cast<std::uint32_t>(random.uniform(0.0, static_cast<double>(mesh.triangles().size())));
  const IndexedTriangle& t = mesh.triangles()[face];
  const Vec3 a = mesh.positions()[t[0]], b = mesh.positions()[t[1]], c = mesh.positions()[t[2]];
  double u = random.uniform(0.0, 1.0), v = random.uniform(0.0, 1.0);
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  return {a + u * (b - a) + v * (c - a), glm::normalize(glm::cross(b - a, c - a)), object, face};
}

/// On a face that is known, or in the air.
inline detail::RayStart random_start(Random& random, std::span<const TriangleMesh> meshes) {
  if (random.uniform(0.0, 1.0) < 0.3) return {.point = random.point(2.0)};
  const FacePoint at = random_face_point(random, meshes);
  return {at.point, static_cast<std::int32_t>(at.object), at.face};
}

/// A point so far from a random edge of a mesh.
inline Vec3 beside_random_edge(Random& random, std::span<const TriangleMesh> meshes, double distance) {
  const auto object = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(meshes.size())));
  const TriangleMesh& mesh = meshes[object];
  const Edge& e =
      mesh.edges()[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(mesh.edges().size())))];
  const Vec3 a = mesh.position(e.from), b = mesh.position(e.to);
  return a + random.uniform(0.0, 1.0) * (b - a) +
         distance * glm::normalize(glm::cross(b - a, random.direction()));
}

using RayCase = detail::Ray;

/// Traces rays in packets and asks the oracle about each.
class RayJudge {
 public:
  explicit RayJudge(const std::vector<TriangleMesh>& meshes)
      : rays_(scene_of(meshes), 1), oracle_(std::span(meshes)) {}

  void add(const RayCase& ray) {
    packet_.set(count_, ray);
    cases_[count_++] = ray;
    // All rays of a packet have an end, or none.
    if (ray.endless != cases_[0].endless) {
      const RayCase last = cases_[--count_];
      finish();
      return add(last);
    }
    if (count_ == detail::RayPacket::kRays) finish();
  }
  void finish() {
    if (count_ == 0) return;
    packet_.endless = cases_[0].endless;
    for (std::size_t k = 0; k < detail::RayPacket::kRays; ++k) packet_.wanted[k] = k < count_ ? -1 : 0;
    detail::find_occluded(rays_, packet_, detail::Coherence::kIncoherent);
    for (std::size_t k = 0; k < count_; ++k) judge(cases_[k], packet_.is_occluded(k));
    count_ = 0;
  }
  std::size_t wrong() const { return wrong_; }
  std::size_t blocked() const { return blocked_; }
  std::size_t free() const { return free_; }

 private:
  static Scene scene_of(const std::vector<TriangleMesh>& meshes) {
    Scene scene;
    for (const TriangleMesh& mesh : meshes) scene.objects.push_back({"caster", mesh, Vec3(0.8), true});
    return scene;
  }
  void judge(const RayCase& ray, bool found) {
    const Vec3& x = ray.from.point;
    std::vector<oracle::CasterFace> own;
    if (ray.from.object >= 0)
      own.push_back({static_cast<std::uint32_t>(ray.from.object), FaceId{ray.from.face}});
    const bool expected = ray.endless
                              ? oracle_.blocked(x, ray.way, own, DistantLight{.direction = -ray.way})
                              : oracle_.blocked(x, x + ray.way, own, DiskLight{x + ray.way, -ray.way, 0.0});
    ++(expected ? blocked_ : free_);
    wrong_ += found != expected;
  }

  RayScene rays_;
  oracle::Oracle oracle_;
  detail::RayPacket packet_;
  RayCase cases_[detail::RayPacket::kRays];
  std::size_t count_ = 0, wrong_ = 0, blocked_ = 0, free_ = 0;
};

}  // namespace penumbra::testing
