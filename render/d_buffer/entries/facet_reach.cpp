#include "render/d_buffer/entries/facet_reach.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "render/rays/ray_packets.h"

namespace penumbra::detail {
namespace {

// Accuracy (DBufferScenes, Resampler.LessensTheError).

/// Rays pass an edge at this distance on its lit side, in the frame of the rays: above the noise of floats,
/// which would make the edge hide itself, and below any feature that counts.
constexpr double kClearance = 2e-5;
/// A hit nearer than this part of the way to the edge hides the edge. A later one is a face at the edge
/// itself.
constexpr double kBefore = 1.0 - 1e-3;

constexpr double kEndless = -std::numeric_limits<double>::infinity();

class Prober {
 public:
  explicit Prober(const ProbeSource& source)
      : rays_(source.rays),
        space_(source.space),
        axes_(light_frame(source.light)),
        center_(source.light.center),
        radius_(source.light.radius) {}

  /// The way from the rim past a point.
  struct Probe {
    Vec3 target;   ///< world
    double angle;  ///< of the contact on the rim
  };

  /// Where the ray from the rim past the target ends.
  double end(const Probe& probe, SupportKind kind) const {
    const std::optional<Ray> ray = aim(probe, kind);
    if (!ray) return kEndless;
    const std::optional<RayHit> hit = first_hit(rays_, *ray);
    if (!hit) return kEndless;
    if (hit->distance < kBefore) return FacetReach::kHidden;
    const Vec3 contact = contact_of(probe);
    return divided(space_.homogeneous(contact + hit->distance * (probe.target - contact))).h;
  }

  /// Leaves of an edge that crosses the light's plane its part in front.
  void cut_to_front(Vec3& a, Vec3& b) const {
    const double da = glm::dot(axes_.w, a - center_), db = glm::dot(axes_.w, b - center_);
    if (da < 0.0 && db > 0.0) a = b + (a - b) * (db / (db - da));
    if (db < 0.0 && da > 0.0) b = a + (b - a) * (da / (da - db));
  }

 private:
  /// None where the contact lies on the target's own line along the rim.
  std::optional<Ray> aim(const Probe& probe, SupportKind kind) const {
    const Vec3 out = outward(probe), contact = contact_of(probe);
    // The plane that touches the rim at the contact and passes the target; its normal points away from the
    // disk.
    Vec3 beyond = glm::cross(glm::cross(axes_.w, out), probe.target - contact);
    const double size = glm::length(beyond);
    if (!(size > 0.0)) return std::nullopt;
    beyond = beyond / size;
    if (glm::dot(beyond, out) < 0.0) beyond = -beyond;
    const Vec3 lit = kind == SupportKind::kPenumbra ? -beyond : beyond;
    const Vec3 way = probe.target - contact + kClearance / rays_.frame().scale * lit;
    return Ray{.from = {.point = contact}, .way = way, .endless = true};
  }

  Vec3 outward(const Probe& probe) const {
    return axes_.u * std::cos(probe.angle) + axes_.v * std::sin(probe.angle);
  }
  Vec3 contact_of(const Probe& probe) const { return center_ + radius_ * outward(probe); }

  const RayScene& rays_;
  const LightSpace& space_;
  const LightFrame axes_;
  const Vec3 center_;
  const double radius_;
};

/// Over up to three places along an edge or round a sector, 0 to 1.
template <class End>
double lowest(int count, const End& end_at) {
  constexpr double kPlaces[] = {0.5, 0.1, 0.9};
  double low = FacetReach::kHidden;
  for (int i = 0; i < count; ++i)
    if (low != kEndless) low = std::min(low, end_at(kPlaces[i]));
  return low;
}

}  // namespace

void find_facet_reach(const TriangleMesh& mesh, const Supports& supports,
                      std::span<const std::uint8_t> probes, const ProbeSource& source, FacetReach& out) {
  const Prober prober(source);
  out.facets.assign(supports.facets.size(), FacetReach::kHidden);
  const auto probe = [&](std::size_t i) {
    const SupportFacet& f = supports.facets[i];
    const Edge& e = mesh.edges()[index(f.edge)];
    Vec3 a = mesh.position(e.from), b = mesh.position(e.to);
    prober.cut_to_front(a, b);
    out.facets[i] = lowest(probes[i], [&](double t) {
      return prober.end({a + t * (b - a), f.rim_angle}, f.kind);
    });
  };
  source.rays.arena().execute([&] { tbb::parallel_for(std::size_t{0}, supports.facets.size(), probe); });
}

void find_cone_reach(const TriangleMesh& mesh, const Supports& supports, std::span<const std::uint8_t> probes,
                     const ProbeSource& source, FacetReach& out) {
  const Prober prober(source);
  out.cones.assign(supports.cones.size(), FacetReach::kHidden);
  const auto probe = [&](std::size_t i) {
    const ConeSector& c = supports.cones[i];
    out.cones[i] = lowest(probes[i], [&](double t) {
      return prober.end({mesh.position(c.vertex), c.from_angle + t * (c.to_angle - c.from_angle)}, c.kind);
    });
  };
  source.rays.arena().execute([&] { tbb::parallel_for(std::size_t{0}, supports.cones.size(), probe); });
}

}  // namespace penumbra::detail
