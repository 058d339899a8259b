#include "render/d_buffer/entries/facet_reach.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/rays/ray_packets.h"

namespace penumbra::detail {
namespace {

constexpr double kEndless = -std::numeric_limits<double>::infinity();

class Prober {
 public:
  explicit Prober(const ProbeSource& source) : from_(source), axes_(light_frame(source.light)) {}

  /// Where the light that grazes the target ends, coming from the rim's point at an angle. What touches the
  /// target hides nothing: rays start on it.
  double end(const RayStart& target, double angle) const {
    const Vec3 out = axes_.u * std::cos(angle) + axes_.v * std::sin(angle);
    const Vec3 way = way_to_center(from_.light, target.point) + from_.light.radius * out;
    if (first_hit(from_.rays, {.from = target, .way = way, .endless = from_.light.is_distant()}))
      return FacetReach::kHidden;
    const std::optional<RayHit> hit = first_hit(from_.rays, {.from = target, .way = -way, .endless = true});
    return hit ? divided(from_.space.homogeneous(target.point - hit->distance * way)).h : kEndless;
  }

  /// Leaves of an edge that crosses the light's plane its part in front.
  void cut_to_front(Vec3& a, Vec3& b) const {
    if (from_.light.is_distant()) return;
    const double da = in_front(a), db = in_front(b);
    if (da < 0.0 && db > 0.0) a = b + (a - b) * (db / (db - da));
    if (db < 0.0 && da > 0.0) b = a + (b - a) * (da / (da - db));
  }

 private:
  double in_front(const Vec3& p) const { return -glm::dot(axes_.w, way_to_center(from_.light, p)); }

  const ProbeSource& from_;
  const LightFrame axes_;
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
      return prober.end({a + t * (b - a), source.object, static_cast<std::uint32_t>(index(e.left))},
                        f.rim_angle);
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
      return prober.end({.point = mesh.position(c.vertex)}, c.from_angle + t * (c.to_angle - c.from_angle));
    });
  };
  source.rays.arena().execute([&] { tbb::parallel_for(std::size_t{0}, supports.cones.size(), probe); });
}

}  // namespace penumbra::detail
