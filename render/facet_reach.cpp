#include "render/facet_reach.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/ray_scene_impl.h"

namespace penumbra::detail {
namespace {

/// Rays pass an edge at this distance (local units), on the lit side: above float's noise, below any feature
/// that counts.
constexpr double kClearance = 2.0 * kRayOffset;
/// A hit this much nearer than the edge hides it; nearer ones are the edge's own faces.
constexpr double kHidden = 1.0 - 1e-3;

class Prober {
 public:
  Prober(const DiskLight& light, const RayScene& rays)
      : rays_(rays), axes_(light_frame(light)), center_(light.center), radius_(light.radius) {}

  /// Reach of the ray from the rim at `angle` past `target` (world).
  float reach(const Vec3& target, double angle, SupportKind kind) const {
    const RayFrame& frame = rays_.frame();
    const Vec3 tangent = axes_.v * std::cos(angle) - axes_.u * std::sin(angle);
    const Vec3 contact = center_ + radius_ * (axes_.u * std::cos(angle) + axes_.v * std::sin(angle));
    // The plane that touches the rim at the contact and passes the target; its normal points away from the
    // disk.
    Vec3 beyond = glm::cross(tangent, target - contact);
    const double size = glm::length(beyond);
    if (!(size > 0.0)) return std::numeric_limits<float>::infinity();
    beyond = beyond / size;
    if (glm::dot(beyond, contact - center_) < 0.0) beyond = -beyond;
    const Vec3 lit = kind == SupportKind::kPenumbra ? -beyond : beyond;
    const Vec3 from = frame.to_local(contact), past = frame.to_local(target) + kClearance * lit;
    const double along = first_hit(from, past - from);
    return along < kHidden ? 0.0f : static_cast<float>(along);
  }

  /// Leaves of an edge that crosses the light's plane its part in front.
  void cut_to_front(Vec3& a, Vec3& b) const {
    const double da = glm::dot(axes_.w, a - center_), db = glm::dot(axes_.w, b - center_);
    if (da < 0.0 && db > 0.0) a = b + (a - b) * (db / (db - da));
    if (db < 0.0 && da > 0.0) b = a + (b - a) * (da / (da - db));
  }

 private:
  double first_hit(const Vec3& from, const Vec3& direction) const {
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(from.x), query.ray.org_y = static_cast<float>(from.y);
    query.ray.org_z = static_cast<float>(from.z);
    query.ray.dir_x = static_cast<float>(direction.x), query.ray.dir_y = static_cast<float>(direction.y);
    query.ray.dir_z = static_cast<float>(direction.z);
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(rays_.impl().casters, &context, &query);
    return query.ray.tfar;
  }

  const RayScene& rays_;
  const LightFrame axes_;
  const Vec3 center_;
  const double radius_;
};

}  // namespace

FacetReach find_reach(const TriangleMesh& mesh, const DiskLight& light, const Supports& supports,
                      const RayScene& rays) {
  const Prober prober(light, rays);
  FacetReach out;
  out.facets.resize(supports.facets.size());
  out.cones.resize(supports.cones.size());
  const auto probe_facet = [&](std::size_t i) {
    const SupportFacet& f = supports.facets[i];
    const Edge& e = mesh.edges()[index(f.edge)];
    Vec3 a = mesh.position(e.from), b = mesh.position(e.to);
    prober.cut_to_front(a, b);
    float reach = 0.0f;
    for (double t : {0.5, 0.1, 0.9})
      if (std::isfinite(reach)) reach = std::max(reach, prober.reach(a + t * (b - a), f.rim_angle, f.kind));
    out.facets[i] = reach;
  };
  const auto probe_cone = [&](std::size_t i) {
    const ConeSector& c = supports.cones[i];
    float reach = 0.0f;
    for (double t : {0.5, 0.1, 0.9})
      if (std::isfinite(reach))
        reach = std::max(reach, prober.reach(mesh.position(c.vertex),
                                             c.from_angle + t * (c.to_angle - c.from_angle), c.kind));
    out.cones[i] = reach;
  };
  rays.impl().arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, supports.facets.size(), probe_facet);
    tbb::parallel_for(std::size_t{0}, supports.cones.size(), probe_cone);
  });
  return out;
}

}  // namespace penumbra::detail
